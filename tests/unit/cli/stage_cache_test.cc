// A stage is run again when code, options or the content of its inputs differ, and only then.
#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "tests/scratch_folder.h"
#include "validation/cli/sha256.h"
#include "validation/cli/stage_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>

namespace pelvireg::cli
{
namespace
{
using ::testing::HasSubstr;

std::string content_of(const std::filesystem::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

/// source.txt -> first -> middle.txt -> second -> last.txt, with a count of what was run.
class Chain : public ::testing::Test
{
protected:
  Chain() { write("source.txt", "one"); }

  void write(const std::string &file, const std::string &text) { dataset::write_text_file(path_ / file, text); }

  Stage stage(const std::string &name, const std::string &input, const std::string &output,
              const std::string &options = "")
  {
    return {.name = name,
            .code = {"synthetic/dataset"},
            .options = options,
            .inputs = {input},
            .outputs = {output},
            .work = [this, input, output](Progress &) -> Notes
            {
              ++n_runs_;
              write(output, content_of(path_ / input) + "+");
              return {{"figure", 4.5}};
            }};
  }
  Stage first(const std::string &options = "") { return stage("first", "source.txt", "middle.txt", options); }
  Stage second() { return stage("second", "middle.txt", "last.txt"); }

  std::filesystem::path elsewhere() const { return path_ / "elsewhere"; }
  /// The first stage, for the directory elsewhere(), which is made with the same source.
  Stage first_made_elsewhere()
  {
    std::filesystem::create_directory(elsewhere());
    dataset::write_text_file(elsewhere() / "source.txt", "one");
    Stage made = first();
    made.work = [this](Progress &) -> Notes
    {
      dataset::write_text_file(elsewhere() / "middle.txt", "made elsewhere");
      return {{"figure", 7}};
    };
    return made;
  }

  /// Each call opens the directory anew, as a new process would.
  Notes run(const Stage &stage)
  {
    return ResultDirectory(path_, "pelvireg test", ResultDirectory::Missing::refuse).run(stage);
  }
  std::string refusal_of(const Stage &stage)
  {
    try
    {
      run(stage);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "not refused";
  }

  const test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_.path();
  int n_runs_ = 0;
};
} // namespace

TEST(Sha256, AgreesWithFips180)
{
  // FIPS 180-4 examples: "abc" and the empty message.
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_F(Chain, IsNotRunAgainWhenNothingHasChanged)
{
  run(first());
  run(second());
  EXPECT_EQ(n_runs_, 2);
  EXPECT_EQ(run(first()).at("figure"), 4.5); // the notes outlive the process
  run(second());
  EXPECT_EQ(n_runs_, 2);
}

TEST_F(Chain, IsRunAgainForOtherOptions)
{
  run(first());
  run(first("spread 0.2"));
  EXPECT_EQ(n_runs_, 2);
}

TEST_F(Chain, IsRunAgainForOtherContentOfTheInput)
{
  run(first());
  write("source.txt", "two");
  run(first());
  EXPECT_EQ(n_runs_, 2);
  EXPECT_EQ(content_of(path_ / "middle.txt"), "two+");
}

TEST_F(Chain, IsRunAgainWhenTheOutputIsGoneOrDamaged)
{
  run(first());
  std::filesystem::remove(path_ / "middle.txt");
  run(first());
  EXPECT_EQ(n_runs_, 2);
  write("middle.txt", "flipped");
  run(first());
  EXPECT_EQ(n_runs_, 3);
}

TEST_F(Chain, IsNotRunAgainForAnInputThatWasRewrittenWithTheSameContent)
{
  run(first());
  write("source.txt", "one");
  run(first());
  EXPECT_EQ(n_runs_, 1);
}

TEST_F(Chain, RefusesAnInputThatWasMadeFromOtherFiles)
{
  run(first());
  write("source.txt", "two");
  EXPECT_THAT(refusal_of(second()), HasSubstr("was made from another source.txt"));
}

TEST_F(Chain, RefusesAnInputThatIsNotWhatItsStageWrote)
{
  run(first());
  write("middle.txt", "flipped");
  EXPECT_THAT(refusal_of(second()), HasSubstr("is not what stage 'first' wrote"));
}

TEST_F(Chain, RefusesAMissingInput)
{
  EXPECT_THAT(refusal_of(second()), HasSubstr("middle.txt' does not exist"));
}

TEST_F(Chain, KeepsTheFormerRecordWhenAStageFails)
{
  run(first());
  Stage failing = first("other");
  failing.work = [](Progress &) -> Notes { throw ComputationError("no"); };
  EXPECT_THROW(run(failing), ComputationError);
  run(first());
  EXPECT_EQ(n_runs_, 1);
}

TEST_F(Chain, GivesAFileToTheStageThatWroteItLast)
{
  run(first());
  run(stage("other", "source.txt", "middle.txt")); // as truth.h5 by reference or import
  EXPECT_EQ(n_runs_, 2);
  run(second());
  EXPECT_EQ(n_runs_, 3);
  EXPECT_THAT(content_of(path_ / "manifest.json"), ::testing::Not(HasSubstr("\"first\"")));
  run(first());
  EXPECT_EQ(n_runs_, 4);
}

TEST_F(Chain, TakesFromElsewhereWhatTheSameStageMadeOfTheSameInputs)
{
  const Stage there = first_made_elsewhere();
  ResultDirectory(elsewhere(), "pelvireg test", ResultDirectory::Missing::refuse).run(there);
  const auto from_there = [&](const std::string &options)
  {
    Stage here = first(options);
    here.elsewhere = {path_ / "missing", elsewhere()};
    return here;
  };

  EXPECT_EQ(run(from_there("")).at("figure"), 7);
  EXPECT_EQ(n_runs_, 0);
  EXPECT_EQ(content_of(path_ / "middle.txt"), "made elsewhere");
  run(second()); // it counts as made here
  EXPECT_EQ(content_of(path_ / "last.txt"), "made elsewhere+");

  run(from_there("other options"));
  EXPECT_EQ(content_of(path_ / "middle.txt"), "one+");
  write("source.txt", "two");
  run(from_there(""));
  EXPECT_EQ(content_of(path_ / "middle.txt"), "two+");

  write("source.txt", "one");
  dataset::write_text_file(elsewhere() / "middle.txt", "changed by hand");
  run(from_there(""));
  EXPECT_EQ(content_of(path_ / "middle.txt"), "one+");
}

TEST_F(Chain, DoesNotTakeFromWhereAnotherProcessWrites)
{
  const Stage there = first_made_elsewhere();
  ResultDirectory writing(elsewhere(), "pelvireg test", ResultDirectory::Missing::refuse);
  writing.run(there);
  Stage here = first();
  here.elsewhere = {elsewhere()};
  run(here);
  EXPECT_EQ(content_of(path_ / "middle.txt"), "one+");
}

TEST_F(Chain, ListsTheDigestOfEveryFileInTheManifest)
{
  run(first());
  EXPECT_THAT(content_of(path_ / "manifest.json"), HasSubstr(sha256_of_file(path_ / "middle.txt")));
}

TEST_F(Chain, RemovesWhatAKilledProcessLeftHalfWritten)
{
  std::ofstream(path_ / "middle.txt.123.tmp") << "half";
  run(first());
  EXPECT_FALSE(std::filesystem::exists(path_ / "middle.txt.123.tmp"));
}

TEST_F(Chain, RefusesADirectoryThatAnotherProcessUses)
{
  const ResultDirectory other(path_, "pelvireg test", ResultDirectory::Missing::refuse);
  EXPECT_THAT(refusal_of(first()), HasSubstr("in use by another pelvireg"));
}

TEST_F(Chain, RefusesADamagedManifest)
{
  write("manifest.json", "{\"format\": ");
  EXPECT_THAT(refusal_of(first()), HasSubstr("manifest.json' is damaged"));
}

TEST_F(Chain, LeavesNoDirectoryWhenNothingWasWritten)
{
  {
    const ResultDirectory made(path_ / "out" / "deep", "pelvireg test", ResultDirectory::Missing::create);
    EXPECT_TRUE(std::filesystem::exists(path_ / "out" / "deep"));
  }
  EXPECT_FALSE(std::filesystem::exists(path_ / "out"));
}
} // namespace pelvireg::cli
