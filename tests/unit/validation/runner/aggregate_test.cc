#include "validation/runner/aggregate.h"

#include <gtest/gtest.h>

#include <cmath>

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
  for (int k = -2; k <= 1; ++k) // slice 2 misses the organ
    evaluation.by_slice.push_back({"full", 0, "uterus", k, 6.0 * k, {5, 1 + 0.25 * 6 * std::abs(k), 0, 0, 0}});
  EXPECT_NEAR(slope_with_distance(evaluation, "full", "uterus").value(), 0.25, 1e-15);
  EXPECT_FALSE(error_by_slice(evaluation, "full", "uterus").back().has_value());
  EXPECT_FALSE(slope_with_distance(evaluation, "full", "bladder").has_value());
}
} // namespace
} // namespace pelvireg::runner
