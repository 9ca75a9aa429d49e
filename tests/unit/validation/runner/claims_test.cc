#include "validation/runner/claims.h"

#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <utility>

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
  auto verdict = verdicts({0, 5.2, -6.6}, 0.0, 0.1);
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

TEST(Claims, OfSmallMotionAreAssessedWithinHalfAMillimetreOfThePapers)
{
  for (const auto &[motion, assessed] :
       {std::pair{7.7 + 1e-9, true}, {7.7 - 1e-9, false}, {8.7 - 1e-9, true}, {8.7 + 1e-9, false}})
  {
    auto verdict = verdicts({0, 0, -motion}, 0.9, 0.5);
    EXPECT_EQ(verdict["below_4_mm"] != "not assessed", assessed) << motion;
    EXPECT_EQ(verdict["vagina_ratio_small_motion"] != "not assessed", assessed) << motion;
  }
}

TEST(Claims, ARatioDoesNotComeFromARunThatDidNotFollowTheImage)
{
  const Eigen::Vector3d translation(0, 5, -6);
  const std::vector<dataset::Estimate> sound = {test::sphere_estimate("full", translation, 0.9),
                                                test::sphere_estimate("no_boundary_conditions", translation, 0.5)};
  const auto ratio_verdict = [&](const std::function<void(dataset::StepRecord &)> &change)
  {
    std::vector<dataset::Estimate> estimates = sound;
    change(estimates[1].samples[0].steps[3]); // the last step of a position
    return assess_claims(evaluate(test::sphere_anatomy(), test::sphere_truth(translation), estimates), {})[2].verdict;
  };
  EXPECT_EQ(ratio_verdict([](dataset::StepRecord &) {}), "confirmed");
  EXPECT_EQ(ratio_verdict([](dataset::StepRecord &step) { step.accepted_control_points = 17; }), "not assessed");
  EXPECT_EQ(ratio_verdict([](dataset::StepRecord &step) { step.in_plane_residual = 0.3 + 1e-12; }), "not assessed");
  EXPECT_EQ(ratio_verdict([](dataset::StepRecord &step) { step.in_plane_residual = 0.3; }), "confirmed");
  EXPECT_EQ(ratio_verdict([](dataset::StepRecord &step) { step.status = "not_finite"; }), "not assessed");
}

TEST(Claims, OfAConditionThatWasNotRunAreNotAssessed)
{
  const Evaluation evaluation = evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), {});
  for (const ClaimVerdict &claim : assess_claims(evaluation, {}))
    EXPECT_EQ(claim.verdict, "not assessed") << claim.id;
}
} // namespace
} // namespace pelvireg::runner
