// The pelvireg program as a person or CI calls it: files, exit status, words.
#include "synthetic/dataset/truth.h"
#include "tests/regression/program.h"
#include "tests/regression/translated_case.h"

#include <cmath>
#include <map>

namespace pelvireg
{
namespace
{
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Content of every HDF5 and CSV file by name.
std::map<std::string, std::string> results_in(const fs::path &folder)
{
  std::map<std::string, std::string> results;
  for (const auto &entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".h5" || entry.path().extension() == ".csv")
      results[entry.path().filename().string()] = content_of(entry.path());
  return results;
}

/// What every increment of a truth must keep: energy within 1 % of the external work, forces, closed volumes.
void expect_balanced(const dataset::Truth &truth)
{
  ASSERT_EQ(truth.balances.size(), truth.increments.size());
  for (std::size_t i = 0; i < truth.increments.size(); ++i)
  {
    const dataset::BalanceRecord &balance = truth.balances[i];
    EXPECT_GT(balance.external_work, 0) << "increment " << i + 1;
    EXPECT_LE(std::abs(balance.energy_error_percent), 1) << "increment " << i + 1;
    EXPECT_LE(balance.force_error, 1e-4 * balance.pressure_resultant.norm()) << "increment " << i + 1;
    EXPECT_GT(balance.reactions.rowwise().norm().maxCoeff(), 0) << "increment " << i + 1;
    const Eigen::VectorXd change =
        truth.increments[i].cavity_volumes.cwiseQuotient(truth.cavity_rest_volumes).array() - 1;
    EXPECT_LE(change.lpNorm<Eigen::Infinity>(), 1e-3) << "increment " << i + 1;
    EXPECT_NEAR(balance.cavity_work.lpNorm<Eigen::Infinity>(), 0, 1e-6 * balance.external_work);
  }
}

/// A line of the case file, what is wrong instead of it, and a word that the sentence must hold.
struct BadValue
{
  std::string pattern, replacement, part;
};
const std::vector<BadValue> bad_values = {
    {"vagina = 0.66", "vagina = 0 #", "youngs_modulus.vagina"},
    {"\nwall = ", "\nwall = -", "wall"},
    {"\ntilt = ", "\ntilted = 1\ntilt = ", "tilted"},
    {"\ntarget_displacement = 3.6", "\ntarget_displacement = nan #", "target_displacement"},
    {"\nn_increments = 8", "\nn_increments = \"many\" #", "n_increments"}};

std::string replaced(std::string text, const std::string &pattern, const std::string &replacement)
{
  const std::size_t place = text.find(pattern);
  EXPECT_NE(place, std::string::npos) << "the case file has no '" << pattern << "'";
  return place == std::string::npos ? text : text.replace(place, pattern.size(), replacement);
}
} // namespace

TEST_F(Program, GivesTheSameBytesForOneAndTwoThreadsAndSkipsWhatIsDone)
{
  const Outcome one = call("run quick --out one --jobs 1");
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("vagina"));
  EXPECT_THAT(one.out, HasSubstr("report: one/report.html"));
  EXPECT_THAT(one.out, HasSubstr("time by phase of a registration step, nominal run of full, mean\n  matching"));
  const Outcome two = call("run quick --out two --jobs 2");
  ASSERT_EQ(two.status, 0) << two.err;

  const auto results_one = results_in(folder_ / "one"), results_two = results_in(folder_ / "two");
  for (const char *name : {"anatomy.h5", "truth.h5", "observations.h5", "estimate-full.h5",
                           "estimate-no_boundary_conditions.h5", "errors_by_step.csv", "errors_by_slice.csv"})
  {
    ASSERT_TRUE(results_one.contains(name) && results_two.contains(name)) << name;
    EXPECT_EQ(results_one.at(name), results_two.at(name)) << name; // not EXPECT_THAT: bytes would be printed
  }

  expect_balanced(dataset::load_truth(folder_ / "one" / "truth.h5"));

  const Outcome again = call("run quick --out one --jobs 2");
  EXPECT_EQ(again.status, 0);
  for (const char *stage : {"anatomy", "reference", "observe", "register full", "evaluate", "report"})
    EXPECT_THAT(again.out, HasSubstr(std::string(stage) + ": up to date"));
  EXPECT_EQ(results_in(folder_ / "one"), results_one);
}

TEST_F(Program, StudiesTheMeshOfACaseAndGivesItsErrorBar)
{
  ASSERT_EQ(call("anatomy quick --out good").status, 0);
  const std::string quick = content_of(folder_ / "good" / "case.toml");
  std::ofstream(folder_ / "small.toml") << replaced(
      replaced(quick, "\ntarget_displacement = 3.6", "\ntarget_displacement = 0.1"), "\nn_increments = 8",
      "\nn_increments = 1");
  const Outcome outcome = call("mesh-study small.toml --ratio 1.25 --out study");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("observed order"));
  const std::string study = content_of(folder_ / "study" / "mesh_study.json");
  for (const char *word : {"case_sha256", "solver_sha256", "\"mean_mm\"", "max_by_organ_mm"})
    EXPECT_THAT(study, HasSubstr(word));
  expect_refused("mesh-study small.toml --ratio 1", "more than 1");
}

TEST_F(Program, RefusesABadCaseWithOneSentenceAndLeavesNothing)
{
  ASSERT_EQ(call("anatomy quick --out good").status, 0);
  const std::string good = content_of(folder_ / "good" / "case.toml");
  fs::remove_all(folder_ / "good");
  const auto expect_case_refused = [&](const std::string &text, const std::string &part)
  {
    std::ofstream(folder_ / "bad.toml") << text;
    expect_refused("run bad.toml --out result", part);
    fs::remove(folder_ / "bad.toml");
    EXPECT_THAT(files(), IsEmpty());
  };
  expect_case_refused(good + "\n[no_such_section]\nkey = 1\n", "no_such_section");
  expect_case_refused(good + "\nnot toml at all", "line");
  for (const auto &[pattern, replacement, part] : bad_values)
    expect_case_refused(replaced(good, pattern, replacement), part);
}

TEST_F(Program, RefusesWhatItDoesNotKnow)
{
  expect_refused("run no_such_case", "no_such_case");
  expect_refused("run", "CASE");
  expect_refused("", "command");
  expect_refused("walk quick", "walk");
  expect_refused("run quick --jobs 0", "--jobs");
  expect_refused("run quick --samples -1", "--samples");
  expect_refused("reference no_such_folder", "no_such_folder");
  expect_refused("register . --condition no_such_condition", "no_such_condition");
  expect_refused("evaluate .", "anatomy.h5");
  expect_refused("export . --format dxf", "dxf");
  expect_refused("compare no_such_baseline .", "MISSING");
  expect_refused("baseline propose . --baseline new", "manifest.json");
  expect_refused("baseline accept no_such_baseline --reason \"no reason to speak of\"", "no candidate");
  expect_refused("baseline accept no_such_baseline", "--reason");
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Program, TakesTheMotionThatAnotherProgramGaveItsDeckAsTruth)
{
  ASSERT_EQ(call("anatomy quick --out a").status, 0);
  expect_refused("export a --format abaqus", "--pressure");
  expect_refused("export a --format abaqus --pressure nan", "nan");
  expect_refused("export a --format abaqus --pressure 0.001 --layers 0", "--layers");
  expect_refused("export a --format abaqus --pressure 0.001 --parts spleen", "spleen");
  expect_refused("export a --format vtk --pressure 0.001", "--pressure");
  EXPECT_FALSE(fs::exists(folder_ / "a" / "abaqus"));
  ASSERT_EQ(call("export a --format abaqus --pressure 0.001").status, 0);
  const std::vector<int> ids = node_ids(content_of(folder_ / "a" / "abaqus" / "pelvis.inp"));

  std::ofstream(folder_ / "short.csv") << translation(ids, 7);
  expect_refused("import a --from short.csv", "8 times");
  std::ofstream(folder_ / "other.csv") << translation({1, 2, 3}, 8);
  expect_refused("import a --from other.csv", "3 nodes");
  std::ofstream(folder_ / "bad.frd") << "not a result";
  expect_refused("import a --from bad.frd", "no nodes");
  expect_refused("import a --from none.csv", "none.csv");
  expect_refused("import a --from short.csv --pressure inf", "inf");
  expect_refused("import a --from a/anatomy.h5", ".frd");
  EXPECT_FALSE(fs::exists(folder_ / "a" / "truth.h5"));

  std::ofstream(folder_ / "good.csv") << translation(ids, 8);
  const Outcome first = call("import a --from good.csv --pressure 0.001");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(content_of(folder_ / "a" / "truth.h5"), HasSubstr("imported displacement table (SHA-256 "));
  EXPECT_THAT(call("import a --from good.csv --pressure 0.001").out, HasSubstr("import: up to date"));
  for (const char *stage : {"observe a", "register a --condition no_boundary_conditions", "evaluate a"})
  {
    const Outcome next = call(stage);
    EXPECT_EQ(next.status, 0) << stage << ": " << next.err;
  }
  EXPECT_THAT(content_of(folder_ / "a" / "manifest.json"), HasSubstr("\"import\""));
}

TEST_F(Program, HasHelpWithExamplesForEveryCommand)
{
  for (const char *command :
       {"", "run", "anatomy", "reference", "observe", "register", "merge", "evaluate", "report", "export", "import",
        "mesh-study", "cavity-study", "compare", "baseline", "baseline propose", "baseline accept"})
  {
    const Outcome outcome = call(std::string(command) + " --help");
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_THAT(outcome.out, HasSubstr("Example")) << command;
    EXPECT_THAT(outcome.err, IsEmpty());
  }
}

TEST_F(Program, ListsItsCases)
{
  const Outcome outcome = call("cases");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("quick"));
  EXPECT_THAT(outcome.out, HasSubstr("t005"));
}
} // namespace pelvireg
