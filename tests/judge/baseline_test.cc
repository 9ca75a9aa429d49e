// What is read from disk is checked, and a baseline changes in one way only.
#include "validation/regression/baseline.h"

#include "synthetic/dataset/error.h"
#include "tests/judge/faults.h"
#include "tests/judge/result_directory.h"
#include "tests/scratch_folder.h"
#include "validation/cli/sha256.h"

#include <gtest/gtest.h>

namespace pelvireg::regression
{
namespace
{
namespace fs = std::filesystem;
using test::edit;

template <class Action> void expect_refused(const Action &action, const std::string &words)
{
  try
  {
    action();
    FAIL() << "no refusal, expected: " << words;
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

class BaselineFiles : public ::testing::Test
{
protected:
  BaselineFiles() { test::write_result(stored(), result); }

  static ErrorResult stored()
  {
    return load_baseline_part(fs::path(PELVIREG_BASELINES) / "quick", cli::sha256_of_text);
  }
  ErrorResult load() const { return load_result(result, cli::sha256_of_text); }
  void propose() const { propose_baseline(result, base, {"packages", "set"}, cli::sha256_of_text); }
  void accept(const std::string &reason, bool renew_anchor = false) const
  {
    accept_baseline(base, reason, renew_anchor, cli::sha256_of_text);
  }
  Comparison compare_with_base() const { return compare(load_baseline(base, cli::sha256_of_text), load()); }
  void replace_result(const ErrorResult &other) const
  {
    fs::remove_all(result);
    test::write_result(other, result);
  }

  test::ScratchFolder folder;
  const fs::path result = folder.path() / "result", base = folder.path() / "base";
};

TEST_F(BaselineFiles, GiveBackWhatWasWritten)
{
  const Comparison comparison = compare({stored(), std::nullopt}, load());
  EXPECT_EQ(comparison.verdict(), Verdict::pass);
}

TEST_F(BaselineFiles, RefuseAResultThatIsNotWhatItsStageWrote)
{
  edit(result / "errors_by_step.csv", "full,0", "full,1");
  expect_refused([&] { load(); }, "is not what was written");
}

TEST_F(BaselineFiles, RefuseOtherUnitsVersionsAndFrames)
{
  const auto expect =
      [&](const std::string &file, const std::string &pattern, const std::string &replacement, const std::string &words)
  {
    replace_result(stored());
    edit(result / file, pattern, replacement, file != "manifest.json");
    expect_refused([&] { load(); }, words);
  };
  expect("summary.json", "\"units\": \"mm\"", "\"units\": \"m\"", "units is 'm'");
  expect("summary.json", "\"format_version\": \"1.0\"", "\"format_version\": \"2.0\"", "format_version is '2.0'");
  expect("manifest.json", "mm-N-MPa-s-t", "m-N-Pa-s-kg", "units is");
  expect("manifest.json", "LPS", "RAS", "frame is 'RAS'");
  expect("manifest.json", "pelvireg manifest", "a manifest", "format is");
  expect("errors_by_step.csv", "mean_mm", "mean_cm", "the first line");
  expect("summary.json", "\"n_failed_steps\": 0", "\"n_failed_steps\": \"no\"", "n_failed_steps");
  expect("summary.json", "\"n_steps\": 24", "\"n_steps\": 25", "the record of the run says");
}

TEST_F(BaselineFiles, RefuseErrorsOfOtherEstimates)
{
  edit(result / "manifest.json", "\"sha256\": \"eeee", "\"sha256\": \"ffff");
  expect_refused([&] { load(); }, "from another 'estimate-full.h5'");
}

TEST_F(BaselineFiles, RefuseAMissingFile)
{
  for (const char *name : {"case.toml", "summary.json", "errors_by_slice.csv", "manifest.json"})
  {
    replace_result(stored());
    fs::remove(result / name);
    expect_refused([&] { load(); }, name);
  }
}

TEST_F(BaselineFiles, AreMissingAtFirstAndNeverMadeSilently)
{
  expect_refused([&] { compare_with_base(); }, "MISSING");
  EXPECT_FALSE(fs::exists(base));
  propose();
  expect_refused([&] { compare_with_base(); }, "MISSING");
}

TEST_F(BaselineFiles, AreAcceptedWithAReasonAndRememberIt)
{
  propose();
  for (const char *reason : {"", "   ", "because", "12345678901234"})
    expect_refused([&] { accept(reason); }, "says nothing");
  accept("the first one, made by hand");
  EXPECT_EQ(compare_with_base().verdict(), Verdict::pass);
  EXPECT_FALSE(fs::exists(base / "candidate"));
  expect_refused([&] { accept("the same once more"); }, "no candidate");

  replace_result(test::scaled(stored(), 1.03));
  propose();
  EXPECT_EQ(compare_with_base().verdict(), Verdict::changed) << "a proposal changes nothing";
  accept("friction is more than it was");
  EXPECT_EQ(compare_with_base().verdict(), Verdict::pass);
  const std::string description = read_text(base / "baseline.json", "");
  EXPECT_NE(description.find("friction is more than it was"), std::string::npos);
  EXPECT_NE(description.find("the first one, made by hand"), std::string::npos);
}

TEST_F(BaselineFiles, KeepTheirAnchorUntilItIsFrozenAnew)
{
  propose();
  accept("the first one, made by hand");
  replace_result(test::scaled(stored(), 1.03));
  propose();
  accept("a small loss for a large gain");
  replace_result(test::scaled(stored(), 1.03 * 1.03));
  EXPECT_EQ(compare_with_base().verdict(), Verdict::worse);
  propose();
  expect_refused([&] { accept("another small loss for nothing"); }, "against the frozen anchor");
  accept("two small losses that are meant", true);
  EXPECT_EQ(compare_with_base().verdict(), Verdict::pass);
}

TEST_F(BaselineFiles, RefuseAChangeByHand)
{
  propose();
  accept("the first one, made by hand");
  edit(base / "errors_by_step.csv", "full,0,bladder,24,", "full,0,bladder,23,");
  expect_refused([&] { compare_with_base(); }, "is not what was written");
  propose();
  edit(base / "candidate" / "runs.csv", "24,0", "24,1");
  expect_refused([&] { accept("a candidate that was touched"); }, "is not what was written");
  fs::copy_file(base / "anchor" / "errors_by_step.csv", base / "errors_by_step.csv",
                fs::copy_options::overwrite_existing);
  fs::remove_all(base / "anchor");
  expect_refused([&] { compare_with_base(); }, "no anchor");
}

TEST_F(BaselineFiles, RefuseACandidateOfAnotherParent)
{
  propose();
  accept("the first one, made by hand");
  propose();
  edit(base / "baseline.json", "made by hand", "made by foot");
  expect_refused([&] { accept("the parent is another now"); }, "propose again");
}

TEST_F(BaselineFiles, RefuseTooFewRuns)
{
  replace_result(test::first_samples(stored(), 3));
  expect_refused([&] { propose(); }, "at least 4");
}
} // namespace
} // namespace pelvireg::regression
