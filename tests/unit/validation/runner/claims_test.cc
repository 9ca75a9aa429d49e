#include "validation/runner/claims.h"

#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

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
  {
    estimate.perturbation.modulus_spread = 0.10;
    for (int sample = 1; sample <= n_random_runs; ++sample)
    {
      estimate.samples.push_back(estimate.samples.front());
      estimate.samples.back().sample = sample;
    }
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

/// Beside the nominal run ten others whose errors are its own, times 1 more or less `deviation`, taking turns: their
/// standard deviation is deviation * sqrt(10 / 9) of their mean.
void spread(Evaluation &evaluation, const std::string &condition, double deviation)
{
  const std::vector<StepError> rows = evaluation.by_step;
  for (int sample = 1; sample <= 10; ++sample)
  {
    evaluation.quality.push_back({condition, sample, 6, 0, 1, 0, 0, 0, 0});
    for (StepError row : rows)
      if (row.condition == condition && row.sample == 0)
      {
        row.sample = sample;
        row.distance.mean *= sample % 2 ? 1 + deviation : 1 - deviation;
        evaluation.by_step.push_back(row);
      }
  }
}

TEST(Claims, OfTheSpreadNeedSmallDeviationsAndModuliWithinTenPercent)
{
  std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", {0, 5, -6}, 0.9),
                                              test::sphere_estimate("no_boundary_conditions", {0, 5, -6}, 0.5)};
  for (dataset::Estimate &estimate : estimates)
    estimate.perturbation.modulus_spread = 0.10;
  const Evaluation nominal = evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), estimates);
  const auto verdict = [&](double with, double without, double modulus_spread = 0.10)
  {
    Evaluation evaluation = nominal;
    spread(evaluation, "full", with * std::sqrt(0.9));
    spread(evaluation, "no_boundary_conditions", without * std::sqrt(0.9));
    evaluation.modulus_spreads["full"] = modulus_spread;
    return assess_claims(evaluation, {})[5].verdict;
  };
  EXPECT_EQ(verdict(0.10 - 1e-9, 0.01 - 1e-9), "confirmed");
  EXPECT_EQ(verdict(0.10 + 1e-9, 0.01 - 1e-9), "refuted");
  EXPECT_EQ(verdict(0.10 - 1e-9, 0.01 + 1e-9), "refuted");
  EXPECT_EQ(verdict(0.05, 0.005, 0.05), "not assessed");
}

TEST(Claims, OfTheFrameRateNeedThePapersSizeAndItsConstraints)
{
  const Evaluation judged = evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}),
                                     {test::sphere_estimate("full", {0, 5, -6}, 0.9)});
  const auto verdict = [&](int n_nodes, double outline, double contacts, double ms)
  {
    Evaluation evaluation = judged;
    evaluation.registration_nodes = {{"all", n_nodes}};
    evaluation.quality[0].mean_outline_constraints = outline;
    evaluation.quality[0].mean_contacts = contacts;
    return assess_claims(evaluation, {{"no_contact", 6, 1, 1, 1}, {"full", 6, ms, ms, ms}}).back().verdict;
  };
  EXPECT_EQ(verdict(4025, 70, 30, 1000 / 14.1), "confirmed");
  EXPECT_EQ(verdict(4025, 70, 30, 1000 / 13.9), "refuted");
  EXPECT_EQ(verdict(6200, 70, 30, 1000 / 8.1), "confirmed");
  EXPECT_EQ(verdict(6200, 70, 30, 1000 / 7.9), "refuted");
  EXPECT_EQ(verdict(4226, 70, 30, 10), "confirmed") << "4.99 % more";
  EXPECT_EQ(verdict(4227, 70, 30, 10), "not assessed") << "5.02 % more";
  EXPECT_EQ(verdict(4025, 59, 30, 10), "not assessed");
  EXPECT_EQ(verdict(4025, 70, 14, 10), "not assessed");
  EXPECT_EQ(verdict(4025, 70, 30, std::nan("")), "not assessed");
}

TEST(Claims, OnSlicesStateHowManyGrazeAnOrgan)
{
  const std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", {0, 5, -6}, 0.9),
                                                    test::sphere_estimate("no_boundary_conditions", {0, 5, -6}, 0.5)};
  const ClaimVerdict claim =
      assess_claims(evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), estimates), {})[3];
  ASSERT_EQ(claim.id, "error_by_slice");
  EXPECT_NE(claim.ours.find("with the 2 left out"), std::string::npos) << claim.ours;
  EXPECT_NE(claim.criterion.find("at least 50 %"), std::string::npos) << claim.criterion;
}

TEST(Claims, OnSlicesNameTheSliceThatIsBelowTheDynPlaneUnlessItGrazesTheOrgan)
{
  // Errors that grow by 0.01 mm/mm with and 0.1 mm/mm without boundary conditions; slices -2 ... 3 meet the ellipsoids.
  const Evaluation judged = evaluate(test::sphere_anatomy(), test::sphere_truth({2, 5, -6}),
                                     {test::sphere_estimate("full", {2, 5, -6}, 0.9),
                                      test::sphere_estimate("no_boundary_conditions", {2, 5, -6}, 0.5)});
  const auto claim_with = [&](int slice, double error)
  {
    Evaluation evaluation = judged;
    for (SliceError &row : evaluation.by_slice)
      row.distance.mean = 1 + std::abs(row.offset) * (row.condition == "full" ? 0.01 : 0.1);
    for (SliceError &row : evaluation.by_slice)
      if (row.condition == "full" && row.organ == "vagina" && row.slice_index == slice)
        row.distance.mean = error;
    return assess_claims(evaluation, {})[3];
  };
  EXPECT_EQ(claim_with(0, 1).verdict, "confirmed") << claim_with(0, 1).ours;
  EXPECT_EQ(claim_with(1, 0.95).verdict, "refuted");
  EXPECT_NE(claim_with(1, 0.95).ours.find("vagina: not least at 0 (1.00 mm, 0.95 mm at 1)"), std::string::npos);
  EXPECT_EQ(claim_with(3, 0.5).verdict, "confirmed") << "less than half of the largest section";
}

TEST(Claims, OfAConditionThatWasNotRunAreNotAssessed)
{
  const Evaluation evaluation = evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), {});
  for (const ClaimVerdict &claim : assess_claims(evaluation, {}))
    EXPECT_EQ(claim.verdict, "not assessed") << claim.id;
}
} // namespace
} // namespace pelvireg::runner
