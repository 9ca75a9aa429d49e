// `pelvireg compare` and `pelvireg baseline` as a CI calls them: exit status, words and files.
#include "tests/judge/faults.h"
#include "tests/judge/result_directory.h"
#include "tests/regression/program.h"
#include "validation/cli/sha256.h"

#include <nlohmann/json.hpp>

namespace pelvireg
{
namespace
{
using ::testing::HasSubstr;

class CompareProgram : public Program
{
protected:
  CompareProgram()
  {
    test::write_result(stored, folder_ / "before");
    test::write_result(stored, folder_ / "same");
    test::write_result(test::scaled(stored, 1.03), folder_ / "changed");
    test::write_result(test::scaled(stored, 1.05), folder_ / "worse");
    test::write_result(test::first_samples(stored, 7), folder_ / "other");
  }

  const regression::ErrorResult stored =
      regression::load_baseline_part(std::filesystem::path(PELVIREG_BASELINES) / "quick", cli::sha256_of_text);
};

TEST_F(CompareProgram, EndsWithZeroOneOrTwo)
{
  EXPECT_EQ(call("compare before same").status, 0);
  EXPECT_EQ(call("compare before same --fail-on-change").status, 0);
  EXPECT_EQ(call("compare before changed").status, 0);
  EXPECT_EQ(call("compare before changed --fail-on-change").status, 1);
  EXPECT_EQ(call("compare before worse").status, 1);
  EXPECT_EQ(call("compare before other").status, 2);
  test::edit(folder_ / "same" / "errors_by_step.csv", ",0.", ",nan", true);
  expect_refused("compare before same", "'nan");
  expect_refused("compare before none", "none");
}

TEST_F(CompareProgram, WritesWhatACiShows)
{
  const Outcome outcome = call("compare before worse --markdown c.md --junit c.xml --json c.json --html c.html");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("WORSE: 16 WORSE, 10 PASS of 26 curve families"));
  EXPECT_THAT(content_of(folder_ / "c.md"), HasSubstr("| **WORSE** | full | vagina | by step |"));
  EXPECT_THAT(content_of(folder_ / "c.xml"), HasSubstr("<testsuites tests=\"26\" failures=\"16\" errors=\"0\">"));
  const auto content = nlohmann::json::parse(content_of(folder_ / "c.json"));
  EXPECT_EQ(content.at("exit_status"), 1);
  EXPECT_EQ(content.at("families").size(), 26u);
  EXPECT_NEAR(content.at("families").at(0).at("average").at("mean_ratio").get<double>(), 1.05, 0.002);
  EXPECT_THAT(content_of(folder_ / "c.html"), HasSubstr("<svg"));
}

TEST_F(CompareProgram, ChangesABaselineByProposeAndAcceptAlone)
{
  expect_refused("compare base same", "MISSING");
  EXPECT_EQ(call("baseline propose before --baseline base").status, 0);
  expect_refused("compare base same", "MISSING");
  expect_refused("baseline accept base --reason no", "says nothing");
  EXPECT_EQ(call("baseline accept base --reason 'the first one of all'").status, 0);
  EXPECT_EQ(call("compare base same").status, 0);
  EXPECT_EQ(call("compare base worse").status, 1);
  const Outcome proposal = call("baseline propose changed --baseline base");
  EXPECT_EQ(proposal.status, 0);
  EXPECT_THAT(proposal.out, HasSubstr("CHANGED: 16 CHANGED"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "base" / "candidate" / "comparison.html"));
  EXPECT_EQ(call("baseline accept base --reason 'friction is more than it was'").status, 0);
  EXPECT_EQ(call("compare base changed --fail-on-change").status, 0);
}
} // namespace
} // namespace pelvireg
