// Real faults in the registration, played on `quick` and held against the stored baseline. What each does to the curves
// is tabled in docs/verification.md.
#include "tests/judge/faults.h"
#include "tests/judge/mutated_run.h"
#include "validation/cli/sha256.h"
#include "validation/regression/comparison_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pelvireg::regression
{
namespace
{
constexpr int n_samples = 4; ///< of the baseline's: the least that is judged

Comparison gate_of(const registration::Mutation &mutation)
{
  static const test::MutatedRun run(PELVIREG_QUICK_RESULT);
  const ErrorResult baseline =
      load_baseline_part(std::filesystem::path(PELVIREG_BASELINES) / "quick", cli::sha256_of_text);
  return test::gate(test::first_samples(baseline, n_samples), run.play(mutation, n_samples));
}
} // namespace

TEST(Mutation, NoneIsNotWorse)
{
  const Comparison comparison = gate_of({});
  EXPECT_EQ(comparison.exit_status(), 0) << comparison_table(comparison);
}

TEST(Mutation, NormalsThatAreNotProjectedAreCaught)
{
  EXPECT_EQ(gate_of({.unprojected_normals = true}).exit_status(), 1);
}

TEST(Mutation, StaleRotationsAreCaught)
{
  EXPECT_EQ(gate_of({.stale_rotations = true}).exit_status(), 1);
}

TEST(Mutation, ADroppedAttachmentIsCaught)
{
  EXPECT_EQ(gate_of({.dropped_attachment = 0}).exit_status(), 1);
}

TEST(Mutation, AModulusThatIsWrongByThreePercentIsSeenAsAChange)
{
  const Comparison comparison = gate_of({.wrong_body = 0, .wrong_factor = 1.03});
  EXPECT_EQ(comparison.exit_status(), 0) << "a loss too small to be one";
  EXPECT_NE(comparison.verdict(), Verdict::pass) << "but not unseen";
}
} // namespace pelvireg::regression
