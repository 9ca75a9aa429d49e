// Shards in any order, and runs picked up after a kill, are the bytes of one register.
#include "validation/runner/merge.h"

#include "synthetic/dataset/error.h"
#include "tests/scratch_folder.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/part_store.h"
#include "validation/runner/register.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace pelvireg::runner
{
namespace
{
namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int samples = 6;
const dataset::StepTimes two_steps{{3, 4}, {"match", "solve"}, {{1, 2}, {1.5, 0.5}}};

std::string bytes_of(const fs::path &file)
{
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

/// Runs 0 … samples, each of its own motion.
dataset::Estimate whole()
{
  dataset::Estimate estimate = test::sphere_estimate("full", {1, 2, 3}, 0.9);
  estimate.perturbation = {.seed = 7, .modulus_spread = 0.1};
  for (int run = 1; run <= samples; ++run)
  {
    estimate.samples.push_back(test::sphere_estimate("full", {1, 2, 3}, 0.9 + 0.01 * run).samples.front());
    estimate.samples.back().sample = run;
  }
  return estimate;
}

class Shards : public ::testing::Test
{
protected:
  Shards() : estimate_(whole()), nominal_(estimate_.samples.front().surfaces)
  {
    for (dataset::EstimateSurface &surface : nominal_)
      surface.positions.clear();
  }

  dataset::EstimatePart part(int shard, int n) const
  {
    return {.samples = samples,
            .shard = shard,
            .n_shards = n,
            .anatomy_sha256 = "anatomy",
            .observations_sha256 = "observations",
            .program_sha256 = "program",
            .nominal_times = {}};
  }

  fs::path write_shard(const std::string &name, const dataset::EstimatePart &part, const dataset::Estimate &estimate,
                       const std::vector<int> &runs) const
  {
    dataset::EstimateWriter writer(folder_ / name, estimate, nominal_, &part);
    for (const int run : runs)
      writer.add(estimate.samples[static_cast<std::size_t>(run)]);
    writer.finish();
    return folder_ / name;
  }
  fs::path write_shard(int shard, int n) const
  {
    return write_shard("shard-" + std::to_string(shard), part(shard, n), estimate_, runs_of_shard(samples, {shard, n}));
  }
  /// Shard 2 of 2 with something else in it.
  fs::path write_other(const std::function<void(dataset::EstimatePart &, dataset::Estimate &)> &change) const
  {
    dataset::EstimatePart other = part(2, 2);
    dataset::Estimate estimate = estimate_;
    change(other, estimate);
    return write_shard("other", other, estimate, runs_of_shard(samples, {2, 2}));
  }

  static void expect_refused(const std::vector<fs::path> &shards, const std::string &words)
  {
    try
    {
      read_shards(shards);
      FAIL() << "no refusal: " << words;
    }
    catch (const InputError &error)
    {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  }

  PartStore store(const std::string &program = "program") const
  {
    dataset::EstimatePart origin = part(1, 1);
    origin.program_sha256 = program;
    return {folder_ / "parts", estimate_, nominal_, origin};
  }

  dataset::Estimate estimate_;
  std::vector<dataset::EstimateSurface> nominal_;
  const test::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};
} // namespace

TEST(RunsOfShard, CoverEveryRunOnce)
{
  for (const int n : {1, 2, 3, 9})
  {
    std::vector<int> times(samples + 1, 0);
    for (int shard = 1; shard <= n; ++shard)
      for (const int run : runs_of_shard(samples, {shard, n}))
        ++times[static_cast<std::size_t>(run)];
    EXPECT_EQ(times, std::vector<int>(samples + 1, 1)) << n << " shards";
  }
}

TEST_F(Shards, GiveTheBytesOfTheWholeInAnyOrder)
{
  save(estimate_, folder_ / "whole.h5");
  for (const int n : {1, 2, 3, 9}) // of nine, two hold no run
  {
    std::vector<fs::path> files;
    for (int shard = n; shard >= 1; --shard)
      files.push_back(write_shard(shard, n));
    for (int rotation = 0; rotation < std::min(n, 3); ++rotation)
    {
      std::rotate(files.begin(), files.begin() + 1, files.end());
      merge_shards(read_shards(files), folder_ / "merged.h5");
      EXPECT_EQ(bytes_of(folder_ / "merged.h5") == bytes_of(folder_ / "whole.h5"), true) << n << " shards";
    }
  }
}

TEST_F(Shards, RefuseAMissingOneADoubledOneAndRunsThatAreNotTheirs)
{
  const fs::path first = write_shard(1, 3), second = write_shard(2, 3), third = write_shard(3, 3);
  expect_refused({}, "no shard");
  expect_refused({third, first}, "shard 2 of 3 of 'full' is missing");
  expect_refused({first, second, third, second}, "shard 2 of 3 is there twice");
  expect_refused({first, second, write_shard("short", part(3, 3), estimate_, {2})},
                 "does not hold the runs of shard 3 of 3");
  expect_refused({first, second, write_shard("wrong", part(4, 3), estimate_, {2})}, "shard 4 of 3");
  save(estimate_, folder_ / "whole.h5");
  expect_refused({folder_ / "whole.h5"}, "must be 'pelvireg estimate part'");
}

TEST_F(Shards, RefuseShardsOfAnotherSetOfRuns)
{
  using Part = dataset::EstimatePart;
  using dataset::Estimate;
  const fs::path first = write_shard(1, 2);
  const auto expect_other_refused = [&](const std::function<void(Part &, Estimate &)> &change, const std::string &words)
  {
    expect_refused({first, write_other(change)}, words);
  };
  expect_other_refused([](Part &, Estimate &estimate) { estimate.perturbation.seed = 8; }, "has seed 8");
  expect_other_refused([](Part &, Estimate &estimate) { estimate.perturbation.modulus_spread = 0.2; },
                       "has spread 0.2");
  expect_other_refused([](Part &, Estimate &estimate) { estimate.perturbation.kind = "outline"; },
                       "has perturbation outline");
  expect_other_refused([](Part &, Estimate &estimate) { estimate.case_name = "cubes"; }, "has case cubes");
  expect_other_refused([](Part &, Estimate &estimate) { estimate.condition = "no_contact"; },
                       "has condition no_contact");
  expect_other_refused([](Part &part, Estimate &) { part.samples = 7; }, "number of randomised runs 7");
  expect_other_refused([](Part &part, Estimate &) { part.n_shards = 3; }, "number of shards 3");
  expect_other_refused([](Part &part, Estimate &) { part.anatomy_sha256 = "x"; }, "has anatomy.h5 (SHA-256) x");
  expect_other_refused([](Part &part, Estimate &) { part.observations_sha256 = "x"; }, "observations.h5");
  expect_other_refused([](Part &part, Estimate &) { part.program_sha256 = "x"; }, "program");
}

TEST_F(Shards, CarryTheNominalRunsStepTimes)
{
  dataset::EstimatePart first = part(1, 2);
  first.nominal_times = two_steps;
  const fs::path file = write_shard("first", first, estimate_, runs_of_shard(samples, {1, 2}));
  const dataset::StepTimes times = read_shards({write_shard(2, 2), file}).origin.nominal_times;
  EXPECT_EQ(times.step_ms, two_steps.step_ms);
  EXPECT_EQ(times.phases, two_steps.phases);
  EXPECT_EQ(times.phase_ms, two_steps.phase_ms);
}

TEST_F(Shards, PartStoreKeepsRunsUntilTheyAreRemovedAndGivesTheBytesOfTheWhole)
{
  save(estimate_, folder_ / "whole.h5");
  const std::vector<int> all = runs_of_shard(samples, {});
  for (const int run : {4, 0, 6, 2}) // a register that was killed
    store().save(estimate_.samples[static_cast<std::size_t>(run)], two_steps);
  EXPECT_TRUE(store().has(4));
  EXPECT_FALSE(store().has(1));
  for (const int run : {5, 1, 3})
    store().save(estimate_.samples[static_cast<std::size_t>(run)], two_steps);
  store().assemble(all, folder_ / "assembled.h5");
  EXPECT_EQ(bytes_of(folder_ / "assembled.h5") == bytes_of(folder_ / "whole.h5"), true);
  EXPECT_EQ(store().nominal_times().step_ms, two_steps.step_ms);
  EXPECT_EQ(store().nominal_times().phase_ms, two_steps.phase_ms);
  store().remove({0, 1, 2});
  EXPECT_TRUE(store().has(3));
  store().remove({3, 4, 5, 6});
  EXPECT_TRUE(fs::is_empty(folder_ / "parts")) << "and the folder stays for others";
}

TEST_F(Shards, PartStoreDoesNotTakeWhatIsDamagedOrFromSomethingElse)
{
  store().save(estimate_.samples[1], {});
  EXPECT_TRUE(store().has(1));
  EXPECT_FALSE(store("another program").has(1));
  dataset::Estimate other = estimate_;
  other.perturbation.seed = 8;
  EXPECT_FALSE(PartStore(folder_ / "parts", other, nominal_, part(1, 1)).has(1));
  fs::copy(folder_ / "parts" / "0001.h5", folder_ / "parts" / "0002.h5");
  EXPECT_FALSE(store().has(2)) << "another run's file";
  fs::resize_file(folder_ / "parts" / "0001.h5", fs::file_size(folder_ / "parts" / "0001.h5") / 2);
  EXPECT_FALSE(store().has(1));
}
} // namespace pelvireg::runner
