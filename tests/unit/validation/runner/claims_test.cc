#include "validation/runner/claims.h"

#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

#include <map>

namespace pelvireg::runner
{
namespace
{
std::map<std::string, std::string> verdicts(const Eigen::Vector3d &translation, double full_share, double bare_share,
                                            int n_random_runs = 0)
{
  std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", translation, full_share),
                                              test::sphere_estimate("no_boundary_conditions", translation, bare_share)};
  for (dataset::Estimate &estimate : estimates)
    for (int sample = 1; sample <= n_random_runs; ++sample)
    {
      estimate.samples.push_back(estimate.samples.front());
      estimate.samples.back().sample = sample;
    }
  std::map<std::string, std::string> result;
  for (const ClaimVerdict &claim :
       assess_claims(evaluate(test::sphere_anatomy(), test::sphere_truth(translation), estimates), {}))
  {
    EXPECT_FALSE(claim.ours.empty()) << claim.id;
    result[claim.id] = claim.verdict;
  }
  return result;
}

TEST(Claims, OfAGoodRegistrationInSmallMotionAreConfirmed)
{
  auto verdict = verdicts({0, 5, -6}, 0.9, 0.5, 10);
  EXPECT_EQ(verdict["better_than_unregistered"], "confirmed");
  EXPECT_EQ(verdict["below_4_mm"], "confirmed");
  EXPECT_EQ(verdict["vagina_ratio_small_motion"], "confirmed");
  EXPECT_EQ(verdict["ratio_large_motion"], "not assessed");
  EXPECT_EQ(verdict["spread_over_runs"], "confirmed");
  EXPECT_EQ(verdict["frame_rate"], "not assessed");
}

TEST(Claims, OfAUselessRegistrationAreRefuted)
{
  auto verdict = verdicts({0, 12, -16}, 0.0, 0.1);
  EXPECT_EQ(verdict["better_than_unregistered"], "refuted");
  EXPECT_EQ(verdict["below_4_mm"], "refuted");
  EXPECT_EQ(verdict["vagina_ratio_small_motion"], "refuted");
  EXPECT_EQ(verdict["error_by_slice"], "refuted");
  EXPECT_EQ(verdict["spread_over_runs"], "not assessed") << "no randomised run";
}

TEST(Claims, OfLargeMotionAreAssessedAbove25Mm)
{
  auto small = verdicts({0, 0, -24.999}, 0.9, 0.5);
  EXPECT_EQ(small["ratio_large_motion"], "not assessed");
  auto large = verdicts({0, 0, -25.001}, 0.9, 0.5);
  EXPECT_EQ(large["ratio_large_motion"], "confirmed");
  EXPECT_EQ(large["below_4_mm"], "not assessed");
}

TEST(Claims, OfAConditionThatWasNotRunAreNotAssessed)
{
  const Evaluation evaluation = evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), {});
  for (const ClaimVerdict &claim : assess_claims(evaluation, {}))
    EXPECT_EQ(claim.verdict, "not assessed") << claim.id;
}
} // namespace
} // namespace pelvireg::runner
