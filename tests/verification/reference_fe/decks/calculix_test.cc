// An unrelated solver moves pieces of the pelvis as the reference does: exported, run with ccx, imported.
#include "tests/scratch_folder.h"
#include "tests/verification/reference_fe/decks/deck_case.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pelvireg::reference_fe
{
namespace
{
class CalculiX : public ::testing::Test
{
protected:
  const test::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};
} // namespace

// A pull, since an empty bladder buckles under a push. What the difference does under refinement: deck_study and
// docs/verification.md.
TEST_F(CalculiX, MovesTheBladderOnItsBarsAsTheReferenceDoes)
{
  const std::vector<double> pressures = {-0.00025, -0.0005, -0.00075, -0.001};
  const dataset::Anatomy coarse = deck_case::bare_parts("quick", {"bladder"}, 4);
  const dataset::Anatomy anatomy = deck_case::refined(coarse);
  const dataset::Truth own = deck_case::moved_by_reference(anatomy, pressures);
  const dataset::Truth ccx = deck_case::moved_by_calculix(anatomy, pressures, {.springs = true}, folder_);
  const deck_case::FieldDifference d =
      deck_case::difference(coarse, ccx, own, 0, own.surfaces[0].displacements[0].rows(), 8);
  EXPECT_GT(d.largest_displacement, 3);
  EXPECT_GT(d.n_away, 300);
  EXPECT_LE(d.largest, 0.02 * d.largest_displacement);
  EXPECT_LE(d.mean, 0.005 * d.largest_displacement);
}

// The same with the deck as it is written by default.
TEST_F(CalculiX, MovesTheRectumOnTrussesAsTheReferenceDoes)
{
  const dataset::Anatomy anatomy = deck_case::bare_parts("quick", {"rectum"}, 2);
  const std::vector<double> pressures = {-0.0005, -0.001};
  const dataset::Truth own = deck_case::moved_by_reference(anatomy, pressures);
  const dataset::Truth ccx = deck_case::moved_by_calculix(anatomy, pressures, {}, folder_);
  const deck_case::FieldDifference d =
      deck_case::difference(anatomy, ccx, own, 0, own.surfaces[0].displacements[0].rows(), 8);
  EXPECT_GT(d.largest_displacement, 1.5);
  EXPECT_LE(d.mean, 0.015 * d.largest_displacement);
}
} // namespace pelvireg::reference_fe
