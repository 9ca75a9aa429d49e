#include "validation/runner/condition_table.h"

#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pelvireg::runner
{
namespace
{
using ::testing::HasSubstr;
using ::testing::Not;

const Eigen::Vector3d translation(2, 3, -6);

/// Moves by `share` of the truth; its last step has a mean in-plane residual of `residual` mm.
dataset::Estimate estimate_of(const std::string &condition, double share, double residual)
{
  dataset::Estimate estimate = test::sphere_estimate(condition, translation, share);
  for (dataset::StepRecord &step : estimate.samples[0].steps)
    step.in_plane_residual = residual;
  return estimate;
}

Evaluation judged(const std::vector<dataset::Estimate> &estimates)
{
  return evaluate(test::sphere_anatomy(), test::sphere_truth(translation), estimates);
}

std::string line_of(const std::string &table, const std::string &condition)
{
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(condition + " ", 0) == 0)
      return line;
  return "no line of " + condition;
}

TEST(ConditionTable, PutsTheResidualBesideEveryErrorAndItsRatioToFull)
{
  const Evaluation evaluation = judged({estimate_of("full", 0.9, 0.02), estimate_of("no_contact", 0.8, 0.123)});
  const std::string table = condition_table(evaluation);
  EXPECT_THAT(line_of(table, "no_contact"), HasSubstr("0.123"));
  EXPECT_THAT(line_of(table, "no_contact"), HasSubstr("95.0 %"));
  EXPECT_THAT(line_of(table, "no_contact"), HasSubstr("0/6"));
  EXPECT_THAT(line_of(table, "no_contact"), HasSubstr("x2.0")) << "twice the share is missing";
  EXPECT_THAT(line_of(table, "full"), HasSubstr("0.020"));
  EXPECT_THAT(line_of(table, "full"), Not(HasSubstr("x")));
  EXPECT_THAT(line_of(table, "unregistered"), Not(HasSubstr("x")));
}

TEST(ConditionTable, GivesNoRatioOfAConditionThatDoesNotFollowItsOutlines)
{
  const auto expect_no_ratio = [](const dataset::Estimate &full, const dataset::Estimate &other) {
    EXPECT_THAT(line_of(condition_table(judged({full, other})), "no_contact"), Not(HasSubstr("x")));
  };
  const dataset::Estimate full = estimate_of("full", 0.9, 0.02);
  expect_no_ratio(full, estimate_of("no_contact", 0.8, 0.31));
  expect_no_ratio(estimate_of("full", 0.9, 0.31), estimate_of("no_contact", 0.8, 0.02));
  dataset::Estimate broken = estimate_of("no_contact", 0.8, 0.02);
  broken.samples[0].steps[1].status = "a step that failed";
  expect_no_ratio(full, broken);
  broken = estimate_of("no_contact", 0.8, 0.02);
  broken.samples[0].steps[1].accepted_control_points = 17; // of 20
  expect_no_ratio(full, broken);
  EXPECT_THAT(condition_table(judged({full, broken})), HasSubstr("does not follow its outlines"));
}

TEST(ConditionTable, KeepsRunsOfDifferentPerturbationsApart)
{
  dataset::Estimate outline = estimate_of("full", 0.8, 0.02);
  outline.perturbation = {.kind = "outline", .outline_sd = 1};
  const Evaluation evaluation = judged({estimate_of("full", 0.9, 0.02), outline});
  EXPECT_EQ(evaluation.conditions, (std::vector<std::string>{"unregistered", "full", "full_outline"}));
  EXPECT_THAT(line_of(condition_table(evaluation), "full_outline"), HasSubstr("x2.0"));
}
} // namespace
} // namespace pelvireg::runner
