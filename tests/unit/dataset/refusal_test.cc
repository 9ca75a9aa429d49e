// The store fails closed: what is not whole, finite, consistent and ours is refused with one sentence.
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"
#include "tests/unit/dataset/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>

namespace pelvireg::dataset::testing
{
namespace
{
using ::testing::HasSubstr;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The message of the InputError that `action` throws.
std::string refusal_of(const std::function<void()> &action)
{
  try
  {
    action();
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "not refused";
}

std::size_t n_files(const ScratchFolder &folder)
{
  const std::filesystem::directory_iterator entries(folder.path());
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

/// Save a changed anatomy, expect the loader to name what is wrong.
void expect_refused(const std::function<void(Anatomy &)> &change, const std::string &sentence_part)
{
  const ScratchFolder folder;
  Anatomy anatomy = sample_anatomy();
  change(anatomy);
  save(anatomy, folder / "anatomy.h5");
  EXPECT_THAT(refusal_of([&] { load_anatomy(folder / "anatomy.h5"); }), HasSubstr(sentence_part));
}
} // namespace

TEST(Loader, RefusesAMissingFile)
{
  EXPECT_THAT(refusal_of([] { load_truth("/nowhere/truth.h5"); }), HasSubstr("'/nowhere/truth.h5' does not exist"));
}

TEST(Loader, RefusesAFileOfAnotherFormat)
{
  const ScratchFolder folder;
  save(sample_truth(), folder / "file.h5");
  EXPECT_THAT(refusal_of([&] { load_anatomy(folder / "file.h5"); }),
              HasSubstr("has format 'pelvireg truth', must be 'pelvireg anatomy'"));
}

TEST(Loader, RefusesAnotherVersion)
{
  const ScratchFolder folder;
  save(sample_truth(), folder / "file.h5");
  std::string bytes = bytes_of(folder / "file.h5");
  const std::size_t version = bytes.find(store_format_version, bytes.find("format_version"));
  ASSERT_NE(version, std::string::npos);
  bytes[version] = '9';
  std::ofstream(folder / "file.h5", std::ios::binary) << bytes;
  EXPECT_THAT(refusal_of([&] { load_truth(folder / "file.h5"); }),
              HasSubstr("has format_version '9.0', must be '1.0'"));
}

TEST(Loader, RefusesEveryTruncation)
{
  const ScratchFolder folder;
  save(sample_estimate(), folder / "whole.h5");
  const std::string bytes = bytes_of(folder / "whole.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 997)
  {
    std::ofstream(folder / "cut.h5", std::ios::binary) << bytes.substr(0, size);
    EXPECT_NE(refusal_of([&] { load_estimate(folder / "cut.h5"); }), "not refused") << size << " bytes";
  }
}

TEST(Loader, RefusesADatasetWithAFlippedBit)
{
  const ScratchFolder folder;
  const Truth truth = sample_truth();
  save(truth, folder / "file.h5");
  std::string bytes = bytes_of(folder / "file.h5");
  const double value = truth.surfaces[0].displacements[1](3, 2);
  const std::string pattern(reinterpret_cast<const char *>(&value), sizeof value);
  const std::size_t place = bytes.find(pattern);
  ASSERT_NE(place, std::string::npos);
  bytes[place] = static_cast<char>(bytes[place] ^ 1);
  std::ofstream(folder / "file.h5", std::ios::binary) << bytes;
  EXPECT_THAT(refusal_of([&] { load_truth(folder / "file.h5"); }), HasSubstr("is damaged"));
}

TEST(Loader, RefusesIndicesOutOfRange)
{
  expect_refused([](Anatomy &anatomy) { anatomy.registration.bodies[0].tets(2, 3) = 6; },
                 "'/registration/bodies/vagina/tets' holds index 6, allowed are 0 to 5");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.shells[0].cells(0, 0) = -1; }, "holds index -1");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.shells[0].region[0] = 4; }, "holds index 4");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.trusses[0].node_a = 12; }, "ends at node 12 of 'vagina'");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.trusses[1].node_b = 11; }, "ends at node 11 of 'uterus'");
}

TEST(Loader, RefusesNamesThatNothingHas)
{
  expect_refused([](Anatomy &anatomy) { anatomy.reference.shells[0].material = "gold"; }, "lacks the material 'gold'");
  expect_refused([](Anatomy &anatomy) { anatomy.registration.attachments[0].body_b = "liver"; }, "body 'liver'");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.ties = {{"vagina", "liver"}}; }, "'liver'");
}

TEST(Loader, RefusesArraysOfDifferentLength)
{
  expect_refused([](Anatomy &anatomy) { anatomy.reference.shells[0].thickness.conservativeResize(11); },
                 "thickness' has 11 rows, must be 12");
  expect_refused([](Anatomy &anatomy) { anatomy.reference.solids[0].region.conservativeResize(2); },
                 "has not one entry a face");
}

TEST(Loader, RefusesAPlaneWhoseNormalIsNotOfUnitLength)
{
  expect_refused([](Anatomy &anatomy) { anatomy.dyn_plane.normal *= 1 + 2e-9; }, "has not length 1");
}

TEST(Loader, RefusesAFileWhoseWriterDidNotFinish)
{
  const ScratchFolder folder;
  save(Truth{}, folder / "file.h5");
  std::string bytes = bytes_of(folder / "file.h5");
  const std::size_t place = bytes.find("complete");
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, 8, "halfdone");
  std::ofstream(folder / "file.h5", std::ios::binary) << bytes;
  EXPECT_THAT(refusal_of([&] { load_truth(folder / "file.h5"); }), HasSubstr("'/complete'"));
}

TEST(Writer, RefusesNanAndLeavesNoFile)
{
  const ScratchFolder folder;
  Truth truth = sample_truth();
  truth.surfaces[1].displacements[1](4, 2) = nan;
  EXPECT_THROW(save(truth, folder / "truth.h5"), ComputationError);
  Anatomy anatomy = sample_anatomy();
  anatomy.control_point_spacing = nan;
  EXPECT_THROW(save(anatomy, folder / "anatomy.h5"), ComputationError);
  EXPECT_EQ(n_files(folder), 0u);
}

TEST(Writer, LeavesTheFormerFileWhenItFails)
{
  const ScratchFolder folder;
  save(sample_truth(), folder / "truth.h5");
  const std::string former = bytes_of(folder / "truth.h5");
  Truth truth = sample_truth();
  truth.surfaces[0].displacements.pop_back();
  EXPECT_THROW(save(truth, folder / "truth.h5"), ComputationError);
  EXPECT_EQ(bytes_of(folder / "truth.h5"), former);
  EXPECT_EQ(n_files(folder), 1u);
}

TEST(Writer, RefusesAFolderThatDoesNotExist)
{
  EXPECT_THROW(save(sample_truth(), "/nowhere/truth.h5"), std::runtime_error);
}

TEST(Writer, RefusesSamplesOnDifferentRestSurfaces)
{
  const ScratchFolder folder;
  Estimate estimate = sample_estimate(); // whose surfaces are perturbed
  estimate.perturbation.kind = "modulus";
  estimate.samples[1].surfaces[1].rest = estimate.samples[0].surfaces[1].rest;
  save(estimate, folder / "estimate.h5");
  estimate.samples[1].surfaces[0].rest.points(0, 0) += 1e-12;
  EXPECT_THROW(save(estimate, folder / "estimate.h5"), ComputationError);
  estimate.perturbation.kind = "surface";
  save(estimate, folder / "estimate.h5");
  estimate.samples[1].surfaces[0].rest.region[0] = 3 - estimate.samples[1].surfaces[0].rest.region[0];
  EXPECT_THROW(save(estimate, folder / "estimate.h5"), ComputationError);
}
} // namespace pelvireg::dataset::testing
