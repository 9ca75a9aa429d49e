#include "validation/runner/aims.h"

#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace pelvireg::runner
{
namespace
{
Evaluation judged(const Eigen::Vector3d &translation, double full_share, double bare_share)
{
  return evaluate(test::sphere_anatomy(), test::sphere_truth(translation),
                  {test::sphere_estimate("full", translation, full_share),
                   test::sphere_estimate("no_boundary_conditions", translation, bare_share)});
}

std::map<std::string, std::string> verdicts(const Evaluation &evaluation)
{
  std::map<std::string, std::string> result;
  for (const Aim &aim : assess_aims(evaluation))
  {
    EXPECT_FALSE(aim.ours.empty()) << aim.id;
    result[aim.id] = aim.verdict;
  }
  return result;
}

TEST(Aims, OfSmallMotionAreMetOrMissedByTheirOwnFigures)
{
  auto good = verdicts(judged({0, 5, -6}, 0.8, 0.5));
  EXPECT_EQ(good["aim_error"], "met");
  EXPECT_EQ(good["aim_reduction"], "met");
  EXPECT_EQ(good["aim_ratio"], "met");
  auto poor = verdicts(judged({0, 5, -6}, 0.5, 0.3));
  EXPECT_EQ(poor["aim_error"], "missed") << "half of 7.8 mm, seen from the surface";
  EXPECT_EQ(poor["aim_reduction"], "missed");
  EXPECT_EQ(poor["aim_ratio"], "missed");
}

TEST(Aims, OfTheErrorAreBoundedByAMillimetreAndAHalf)
{
  // The same evaluation, its worst step moved to either side of the bound.
  for (const auto &[error, verdict] : {std::pair{1.5, "met"}, {1.5 + 1e-12, "missed"}})
  {
    Evaluation evaluation = judged({0, 5, -6}, 0.9, 0.5);
    for (StepError &row : evaluation.by_step)
      if (row.condition == "full" && row.organ == "rectum" && row.step == 3)
        row.distance.mean = error;
    EXPECT_EQ(verdicts(evaluation)["aim_error"], verdict) << error;
  }
}

TEST(Aims, OfLargeMotionHaveTheirOwnBounds)
{
  auto large = verdicts(judged({0, 0, -26}, 0.8, 0.4)); // 5.2 mm left of 26: about 2.6 mm from the surface
  EXPECT_EQ(large["aim_error"], "met");
  EXPECT_EQ(large["aim_ratio"], "missed") << "three times, four are wanted";
}

TEST(Aims, OfAnotherMotionOrWithoutRunsAreNotAssessed)
{
  for (const auto &[id, verdict] : verdicts(evaluate(test::sphere_anatomy(), test::sphere_truth({0, 5, -6}), {})))
    EXPECT_EQ(verdict, "not assessed") << id;
  auto between = verdicts(judged({0, 0, -15}, 0.8, 0.4));
  EXPECT_EQ(between["aim_error"], "not assessed");
  EXPECT_EQ(between["aim_ratio"], "not assessed");
}
} // namespace
} // namespace pelvireg::runner
