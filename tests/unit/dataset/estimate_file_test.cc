// Estimates run by run, and parts of estimates.
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/estimate_file.h"
#include "tests/unit/dataset/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pelvireg::dataset::testing
{
namespace
{
using ::testing::HasSubstr;

std::vector<EstimateSurface> rest_of(const EstimateSample &sample)
{
  std::vector<EstimateSurface> surfaces;
  for (const EstimateSurface &surface : sample.surfaces)
    surfaces.push_back({surface.name, surface.rest, {}});
  return surfaces;
}

const EstimatePart part{.samples = 12,
                        .shard = 2,
                        .n_shards = 5,
                        .anatomy_sha256 = "aa",
                        .observations_sha256 = "bb",
                        .program_sha256 = "cc",
                        .nominal_times = {{1.5, 2.5}, {"match", "solve"}, {{1, 2}, {0.25, 0.5}}}};

template <typename Call> std::string refusal_of(const Call &call)
{
  try
  {
    call();
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "not refused";
}
} // namespace

TEST(EstimateWriter, GivesTheBytesOfTheWholeWhenRunsAreAddedOneByOne)
{
  const ScratchFolder folder;
  const Estimate estimate = sample_estimate();
  save(estimate, folder / "whole.h5");
  EstimateWriter writer(folder / "one_by_one.h5", estimate, rest_of(estimate.samples[0]));
  for (const EstimateSample &sample : estimate.samples)
    writer.add(sample);
  EXPECT_FALSE(std::filesystem::exists(folder / "one_by_one.h5")) << "it has no name before it is whole";
  writer.finish();
  EXPECT_EQ(bytes_of(folder / "one_by_one.h5"), bytes_of(folder / "whole.h5"));
}

TEST(EstimateWriter, RefusesRunsThatDoNotAscendOrDoNotFit)
{
  const ScratchFolder folder;
  const Estimate estimate = sample_estimate();
  EstimateWriter writer(folder / "file.h5", estimate, rest_of(estimate.samples[0]));
  writer.add(estimate.samples[1]);
  EXPECT_THROW(writer.add(estimate.samples[1]), ComputationError);
  EXPECT_THROW(writer.add(estimate.samples[0]), ComputationError);
  EstimateSample other = estimate.samples[1];
  other.sample = 9;
  other.surfaces[0].rest.triangles.row(0).reverseInPlace();
  EXPECT_THROW(writer.add(other), ComputationError);
  other = estimate.samples[1];
  other.sample = 9;
  other.surfaces[0].positions.pop_back();
  EXPECT_THROW(writer.add(other), ComputationError);
}

TEST(EstimateReader, ReadsOneRunWithItsOwnRestSurface)
{
  const ScratchFolder folder;
  const Estimate estimate = sample_estimate();
  save(estimate, folder / "file.h5");
  const EstimateReader reader(folder / "file.h5");
  EXPECT_EQ(reader.numbers(), (std::vector<std::int32_t>{0, 7}));
  EXPECT_TRUE(reader.description().samples.empty());
  EXPECT_EQ(reader.sample(7).surfaces[1].rest.points, estimate.samples[1].surfaces[1].rest.points);
  EXPECT_EQ(reader.sample(7).surfaces[0].rest.points, estimate.samples[0].surfaces[0].rest.points);
  EXPECT_NE(reader.sample(7).surfaces[1].rest.points, reader.rest_surfaces()[1].rest.points);
  EXPECT_NE(refusal_of([&] { reader.sample(3); }), "not refused");
}

TEST(EstimatePartFile, ComesBackExactlyAndIsNotTakenForAWhole)
{
  const ScratchFolder folder;
  const Estimate estimate = sample_estimate();
  EstimateWriter writer(folder / "part.h5", estimate, rest_of(estimate.samples[0]), &part);
  writer.add(estimate.samples[1]);
  writer.finish();
  const EstimateReader reader(folder / "part.h5", EstimateReader::Kind::part);
  EXPECT_EQ(reader.part().samples, 12);
  EXPECT_EQ(reader.part().shard, 2);
  EXPECT_EQ(reader.part().n_shards, 5);
  EXPECT_EQ(reader.part().anatomy_sha256 + reader.part().observations_sha256 + reader.part().program_sha256, "aabbcc");
  EXPECT_EQ(reader.part().nominal_times.step_ms, part.nominal_times.step_ms);
  EXPECT_EQ(reader.part().nominal_times.phases, part.nominal_times.phases);
  EXPECT_EQ(reader.part().nominal_times.phase_ms, part.nominal_times.phase_ms);
  EXPECT_EQ(reader.sample(7).surfaces[0].positions, estimate.samples[1].surfaces[0].positions);
  EXPECT_THAT(refusal_of([&] { load_estimate(folder / "part.h5"); }), HasSubstr("'pelvireg estimate part'"));
  save(estimate, folder / "whole.h5");
  EXPECT_THAT(refusal_of([&] { EstimateReader(folder / "whole.h5", EstimateReader::Kind::part); }),
              HasSubstr("must be 'pelvireg estimate part'"));
}

TEST(EstimatePartFile, IsRefusedWhenAPhaseHasNotOneTimeAStep)
{
  const ScratchFolder folder;
  const Estimate estimate = sample_estimate();
  EstimatePart bad = part;
  bad.nominal_times.phase_ms[1].pop_back();
  EstimateWriter writer(folder / "part.h5", estimate, rest_of(estimate.samples[0]), &bad);
  writer.add(estimate.samples[1]);
  writer.finish();
  EXPECT_THAT(refusal_of([&] { EstimateReader(folder / "part.h5", EstimateReader::Kind::part); }),
              HasSubstr("nominal_phase_ms/solve"));
}
} // namespace pelvireg::dataset::testing
