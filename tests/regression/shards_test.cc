// Many runs: shards, merge, a kill in the middle, conditions and perturbations, as a person or a cluster calls them.
#include "tests/regression/translated_case.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <unistd.h>

namespace pelvireg
{
namespace
{
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Not EXPECT_EQ: bytes would be printed.
bool have_same_bytes(const fs::path &a, const fs::path &b)
{
  return fs::exists(a) && fs::exists(b) && content_of(a) == content_of(b);
}

std::size_t n_files_in(const fs::path &folder)
{
  std::size_t n = 0;
  if (fs::exists(folder))
    for (const auto &entry : fs::directory_iterator(folder))
      n += entry.path().extension() == ".h5";
  return n;
}

class ManyRuns : public TranslatedCase
{
protected:
  void SetUp() override { make_translated("base"); }

  /// The program, running.
  pid_t start(const std::vector<std::string> &arguments) const
  {
    const pid_t child = ::fork();
    if (child != 0)
      return child;
    std::vector<char *> words = {const_cast<char *>(PELVIREG_PROGRAM)};
    for (const std::string &argument : arguments)
      words.push_back(const_cast<char *>(argument.c_str()));
    words.push_back(nullptr);
    if (::chdir(folder_.c_str()) == 0 && std::freopen("/dev/null", "w", stdout))
      ::execv(PELVIREG_PROGRAM, words.data());
    ::_exit(127);
  }

  /// Start the program, kill it (SIGKILL) once `folder` holds `n` files.
  void kill_when(const std::vector<std::string> &arguments, const fs::path &folder, std::size_t n) const
  {
    const pid_t child = start(arguments);
    int status = 0;
    while (n_files_in(folder) < n && ::waitpid(child, &status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the program ended before it could be killed";
  }

  /// Start the program and kill it after a while, wherever it is then.
  void kill_after(const std::vector<std::string> &arguments, std::chrono::milliseconds while_) const
  {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(while_);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
  }
};
} // namespace

TEST_F(ManyRuns, ShardsInAnyOrderGiveTheBytesOfOneRegister)
{
  const std::string options = " --samples 5 --seed 3 --condition full,no_boundary_conditions";
  copy("base", "one");
  copy("base", "many");
  copy("base", "elsewhere");
  ASSERT_EQ(call("register one --jobs 2" + options).status, 0);
  ASSERT_EQ(call("register elsewhere --shard 3/3" + options).status, 0);
  const std::string shard = "'" PELVIREG_PROGRAM "' register many --jobs 1" + options + " --shard ";
  const std::string two_at_once =
      fmt::format("cd '{}' && {{ {}2/3 >one.log & {}1/3 >two.log & wait; }}", folder_.string(), shard, shard);
  ASSERT_EQ(std::system(two_at_once.c_str()), 0);
  EXPECT_THAT(call("register many --shard 2/3" + options).out, HasSubstr("up to date"));

  expect_refused("merge many", "shard 3 of 3 of 'full' is missing");
  EXPECT_FALSE(fs::exists(folder_ / "many" / "estimate-full.h5"));
  const Outcome merged =
      call("merge many many/shard-full-2-of-3.h5 elsewhere/shard-full-3-of-3.h5 "
           "many/shard-full-1-of-3.h5 elsewhere/shard-no_boundary_conditions-3-of-3.h5 "
           "many/shard-no_boundary_conditions-1-of-3.h5 many/shard-no_boundary_conditions-2-of-3.h5");
  ASSERT_EQ(merged.status, 0) << merged.err;
  for (const char *file : {"estimate-full.h5", "estimate-no_boundary_conditions.h5"})
    EXPECT_TRUE(have_same_bytes(folder_ / "one" / file, folder_ / "many" / file)) << file;
  EXPECT_THAT(call("register many" + options).out, HasSubstr("register full: up to date"));
  EXPECT_EQ(n_files_in(folder_ / "many" / "parts-full"), 0u);
  EXPECT_EQ(call("evaluate many").status, 0);
}

TEST_F(ManyRuns, RefuseShardsThatDoNotBelongTogether)
{
  for (const char *shard : {"0/2", "3/2", "1", "1/0", "-1/2", "1/2x", "a/b", "1/501"})
    expect_refused("register base --shard " + std::string(shard), "must be i/n");
  expect_refused("merge base", "holds no shard");
  const std::string bare = "register base --condition no_boundary_conditions --samples 1";
  ASSERT_EQ(call(bare + " --shard 1/2").status, 0);
  expect_refused("merge base", "shard 2 of 2 of 'no_boundary_conditions' is missing");
  copy("base", "other");
  ASSERT_EQ(call("register other --condition no_boundary_conditions --samples 1 --seed 2 --shard 2/2").status, 0);
  const std::string first = "base/shard-no_boundary_conditions-1-of-2.h5",
                    second = "shard-no_boundary_conditions-2-of-2.h5";
  expect_refused("merge base " + first + " other/" + second, "has seed 2");
  expect_refused("merge base " + first + " " + first, "is there twice");
  ASSERT_EQ(call(bare + " --shard 2/2").status, 0);

  // The same shards, but the directory's observations are of another motion by now.
  std::ofstream(folder_ / "other.csv") << translation(node_ids(content_of(folder_ / "base" / "abaqus" / "pelvis.inp")),
                                                      8, 0.2);
  copy("base", "moved");
  ASSERT_EQ(call("import moved --from other.csv").status, 0);
  ASSERT_EQ(call("observe moved").status, 0);
  expect_refused("merge moved", "another observations.h5");
  EXPECT_EQ(call("merge base").status, 0);
}

TEST_F(ManyRuns, ARegisterThatIsKilledInTheMiddleGoesOnAndGivesTheSameBytes)
{
  const std::string options = " --condition full --samples 10 --jobs 1";
  copy("base", "whole");
  copy("base", "shard");
  ASSERT_EQ(call("register whole" + options).status, 0);

  const fs::path parts = folder_ / "base" / "parts-full", estimate = folder_ / "base" / "estimate-full.h5";
  kill_when({"register", "base", "--condition", "full", "--samples", "10", "--jobs", "1"}, parts, 3);
  EXPECT_GE(n_files_in(parts), 3u);
  EXPECT_LT(n_files_in(parts), 11u);
  EXPECT_FALSE(fs::exists(estimate));
  const Outcome resumed = call("register base" + options);
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("resumed, "));
  EXPECT_TRUE(have_same_bytes(estimate, folder_ / "whole" / "estimate-full.h5"));
  EXPECT_FALSE(fs::exists(parts));

  // A shard that is killed, and what it leaves taken up by a register of all.
  kill_when({"register", "shard", "--condition", "full", "--samples", "10", "--jobs", "1", "--shard", "2/2"},
            folder_ / "shard" / "parts-full", 2);
  EXPECT_THAT(call("register shard" + options).out, HasSubstr("resumed, "));
  EXPECT_TRUE(have_same_bytes(folder_ / "shard" / "estimate-full.h5", folder_ / "whole" / "estimate-full.h5"));

  // What a killed register of another seed left is not taken.
  copy("whole", "seed");
  kill_when({"register", "seed", "--condition", "full", "--samples", "10", "--jobs", "1", "--seed", "2"},
            folder_ / "seed" / "parts-full", 2);
  fs::remove(folder_ / "seed" / "estimate-full.h5");
  EXPECT_THAT(call("register seed" + options).out, Not(HasSubstr("resumed")));
  EXPECT_TRUE(have_same_bytes(folder_ / "seed" / "estimate-full.h5", folder_ / "whole" / "estimate-full.h5"));
}

TEST_F(ManyRuns, AnEvaluateThatIsKilledAnywhereLeavesNoPartOfAFileAndGivesTheSameBytesAfterwards)
{
  ASSERT_EQ(call("register base --condition full,no_boundary_conditions --samples 4 --jobs 1").status, 0);
  copy("base", "whole");
  ASSERT_EQ(call("evaluate whole").status, 0);
  const std::vector<std::string> results = {"errors_by_step.csv",     "errors_by_slice.csv", "metrics_by_step.csv",
                                            "errors_by_distance.csv", "curves_by_step.csv",  "curves_by_slice.csv",
                                            "summary.json",           "error_table.txt",     "condition_table.txt"};
  for (const int milliseconds : {20, 60, 120, 250, 500})
  {
    kill_after({"evaluate", "base", "--jobs", "2"}, std::chrono::milliseconds(milliseconds));
    for (const std::string &file : results)
      EXPECT_TRUE(!fs::exists(folder_ / "base" / file) ||
                  have_same_bytes(folder_ / "base" / file, folder_ / "whole" / file))
          << file << " after " << milliseconds << " ms";
  }
  const Outcome again = call("evaluate base --jobs 2");
  EXPECT_EQ(again.status, 0) << again.err;
  for (const std::string &file : results)
    EXPECT_TRUE(have_same_bytes(folder_ / "base" / file, folder_ / "whole" / file)) << file;
  EXPECT_THAT(call("evaluate base").out, HasSubstr("evaluate: up to date"));
}

TEST_F(ManyRuns, AllConditionsRunFromOneCommandIntoOneTable)
{
  ASSERT_EQ(call("register base --condition all").status, 0);
  const Outcome judged = call("evaluate base");
  ASSERT_EQ(judged.status, 0) << judged.err;
  const std::string table = content_of(folder_ / "base" / "condition_table.txt");
  EXPECT_THAT(judged.out, HasSubstr(table));
  for (const char *condition : {"unregistered", "full", "no_boundary_conditions", "no_contact", "no_friction",
                                "no_ligaments", "no_fascia", "no_uterus_attachment"})
  {
    EXPECT_THAT(table, HasSubstr(fmt::format("\n{} ", condition)));
    EXPECT_THAT(content_of(folder_ / "base" / "curves_by_step.csv"), HasSubstr(fmt::format("\n{},", condition)));
  }
}

TEST_F(ManyRuns, EveryPerturbationHasItsOwnFileAndItsOwnRows)
{
  expect_refused("register base --perturb weather", "--perturb");
  expect_refused("register base --perturb outline", "--samples 0");
  expect_refused("register base --samples 1 --perturb outline --spread 0.2", "--spread was given");
  expect_refused("register base --samples 1 --surface-sd 1", "--surface-sd was given");
  expect_refused("register base --samples 1 --perturb outline --outline-sd -1", "must be at least 0");
  expect_refused("register base --samples 1 --perturb plane --plane-tilt-sd 90", "tilt");
  expect_refused("register base --samples 1 --perturb surface --correlation-length 0", "correlation length");
  expect_refused("register base --samples 1 --perturb surface --correlation-length 0.5 --condition full",
                 "inverts element");
  expect_refused("register base --samples 1 --spread 1", "below 1");
  EXPECT_FALSE(fs::exists(folder_ / "base" / "estimate-full.h5"));
  EXPECT_FALSE(fs::exists(folder_ / "base" / "parts-full_surface"));

  ASSERT_EQ(call("register base --condition full --samples 1 --perturb modulus,surface,outline,plane").status, 0);
  const Outcome judged = call("evaluate base");
  ASSERT_EQ(judged.status, 0) << judged.err;
  const std::string rows = content_of(folder_ / "base" / "errors_by_step.csv");
  for (const char *label : {"full", "full_surface", "full_outline", "full_plane"})
  {
    EXPECT_TRUE(fs::exists(folder_ / "base" / fmt::format("estimate-{}.h5", label))) << label;
    for (const char *sample : {"0", "1"})
      EXPECT_THAT(rows, HasSubstr(fmt::format("\n{},{},vagina,24,", label, sample)));
  }
}
} // namespace pelvireg
