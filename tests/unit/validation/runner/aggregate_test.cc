#include "validation/runner/aggregate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

namespace pelvireg::runner
{
namespace
{
void add_run(Evaluation &evaluation, int sample, double error)
{
  evaluation.quality.push_back({"full", sample, 1, 0, 1, 0, 0, 0, 0});
  evaluation.by_step.push_back({"full", sample, "vagina", 1, {10, error, 0, error, error}});
}

TEST(Aggregate, CountsTheRandomisedRunsAndNotTheNominalOne)
{
  Evaluation evaluation;
  add_run(evaluation, 0, 100);
  add_run(evaluation, 1, 2);
  add_run(evaluation, 2, 4);
  const Aggregate aggregate = error_by_step(evaluation, "full", "vagina").at(0);
  EXPECT_EQ(aggregate.n_runs, 2);
  EXPECT_DOUBLE_EQ(aggregate.mean, 3);
  EXPECT_DOUBLE_EQ(aggregate.sd, std::sqrt(2.0));
}

TEST(Aggregate, OfTheNominalRunAloneIsThatRun)
{
  Evaluation evaluation;
  add_run(evaluation, 0, 5);
  const Aggregate aggregate = error_by_step(evaluation, "full", "vagina").at(0);
  EXPECT_EQ(aggregate.n_runs, 1);
  EXPECT_EQ(aggregate.mean, 5);
  EXPECT_EQ(aggregate.sd, 0);
}

TEST(SlopeWithDistance, OfALineOnBothSidesIsItsSlope)
{
  Evaluation evaluation;
  evaluation.slice_pitch = 6;
  evaluation.n_slices_each_side = 2;
  for (int k = -2; k <= 2; ++k)
    evaluation.sections.push_back({"uterus", k, 100, 1});
  for (int k = -2; k <= 1; ++k) // slice 2 misses the organ
    evaluation.by_slice.push_back({"full", 0, "uterus", k, 6.0 * k, {5, 1 + 0.25 * 6 * std::abs(k), 0, 0, 0}});
  EXPECT_NEAR(slope_with_distance(evaluation, "full", "uterus").value().value, 0.25, 1e-15);
  EXPECT_FALSE(error_by_slice(evaluation, "full", "uterus").back().has_value());
  EXPECT_FALSE(slope_with_distance(evaluation, "full", "bladder").has_value());
}

TEST(SlopeWithDistance, LeavesSlicesOutThatGrazeTheOrganAndSaysHowMany)
{
  Evaluation evaluation;
  evaluation.slice_pitch = 6;
  evaluation.n_slices_each_side = 3;
  for (int k = -3; k <= 3; ++k)
  {
    const double share = std::abs(k) == 3 ? least_section_share - 1e-12 : k == -2 ? least_section_share : 1;
    evaluation.by_slice.push_back(
        {"full", 0, "uterus", k, 6.0 * k, {5, std::abs(k) == 3 ? 50 : 1.5 * std::abs(k), 0, 0, 0}});
    if (k != 2) // of slice 2 the section is not known
      evaluation.sections.push_back({"uterus", k, 100 * share, share});
  }
  const auto slope = slope_with_distance(evaluation, "full", "uterus");
  ASSERT_TRUE(slope.has_value());
  EXPECT_NEAR(slope->value, 0.25, 1e-15);
  EXPECT_EQ(slope->n_slices, 4);
  EXPECT_EQ(slope->n_left_out, 3);
  const auto all = slope_with_distance(evaluation, "full", "uterus", true);
  EXPECT_GT(all->value, 1);
  EXPECT_EQ(all->n_slices, 7);
  EXPECT_EQ(all->n_left_out, 0);
}

TEST(MetricAtLastStep, IsOverTheRandomisedRunsAndTheLastStepAlone)
{
  Evaluation evaluation;
  evaluation.n_increments = 2;
  evaluation.steps_per_increment = 3;
  for (const auto &[sample, step, dice] : {std::tuple{0, 6, 0.1}, {1, 3, 0.2}, {1, 6, 0.8}, {2, 6, 0.9}})
  {
    evaluation.quality.push_back({"full", sample, 1, 0, 1, 0, 0, 0, 0});
    StepMetrics row;
    row.condition = "full";
    row.sample = sample;
    row.organ = "vagina";
    row.step = step;
    row.dice = dice;
    evaluation.metrics_by_step.push_back(row);
  }
  for (const MetricFigure &figure : metric_figures())
    if (std::string(figure.name) == "dice")
    {
      const auto value = metric_at_last_step(evaluation, "full", "vagina", figure);
      EXPECT_EQ(value->n_runs, 2);
      EXPECT_NEAR(value->mean, 0.85, 1e-15);
      EXPECT_FALSE(metric_at_last_step(evaluation, "full", "uterus", figure).has_value());
    }
}

TEST(ErrorByDistance, IsOverTheRunsSlabBySlab)
{
  Evaluation evaluation;
  add_run(evaluation, 0, 5);
  for (const auto &[bin, surface, material] : {std::tuple{-1, 1.0, 2.0}, {2, 3.0, 7.0}})
    evaluation.by_distance.push_back({"full", 0, "vagina", bin, {10, surface, 0, surface, surface}, material});
  const auto slabs = error_by_distance(evaluation, "full", "vagina");
  ASSERT_EQ(slabs.size(), 2u);
  EXPECT_EQ(slabs[1].bin, 2);
  EXPECT_EQ(slabs[1].surface.mean, 3);
  EXPECT_EQ(slabs[1].material.mean, 7);
}
} // namespace
} // namespace pelvireg::runner
