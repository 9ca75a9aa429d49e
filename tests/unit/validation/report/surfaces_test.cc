#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/report/slice_contours.h"
#include "validation/report/worst_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pelvireg::report
{
namespace
{
const Eigen::Vector3d translation(2, 5, -6);

struct Spheres
{
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Truth truth = test::sphere_truth(translation);
  std::vector<dataset::Estimate> estimates;
  runner::Evaluation evaluation;
  ReportInputs inputs;

  explicit Spheres(std::vector<dataset::Estimate> given)
      : estimates(std::move(given)),
        evaluation(runner::evaluate(anatomy, truth, estimates)), inputs{evaluation, anatomy, truth, estimates,
                                                                        {},         {},      {}}
  {
  }
};

TEST(NominalSurfaces, ShowOneRunOfAConditionWhateverIsPerturbed)
{
  dataset::Estimate outline = test::sphere_estimate("full", translation, 0.9);
  outline.perturbation.kind = "outline";
  const Spheres spheres({test::sphere_estimate("full", translation, 0.9), outline});
  std::vector<std::string> shown;
  for (const ConditionSurfaces &condition : nominal_surfaces(spheres.inputs))
    shown.push_back(condition.condition);
  EXPECT_EQ(shown, (std::vector<std::string>{"unregistered", "full"}));
}

TEST(NominalSurfaces, BeginAtRestAndHoldEveryStep)
{
  const Spheres spheres({test::sphere_estimate("full", translation, 0.9)});
  const auto conditions = nominal_surfaces(spheres.inputs);
  EXPECT_EQ(conditions[0].organs[0].frames.size(), 1u);
  EXPECT_EQ(conditions[1].organs[0].frames.size(), 1u + test::n_increments * test::steps_per_increment);
  EXPECT_TRUE(conditions[1].organs[0].at(0).isApprox(conditions[0].organs[0].at(99)));
  EXPECT_EQ(truth_surfaces(spheres.truth)[0].frames.size(), 1u + test::n_increments);
}

TEST(SliceDrawing, ChainsTheSegmentsOfAnOrganIntoOneClosedCurve)
{
  const Spheres spheres({test::sphere_estimate("full", translation, 0.9)});
  const auto truth = truth_surfaces(spheres.truth);
  const SliceDrawing drawing = slice_drawing(spheres.inputs, truth, nominal_surfaces(spheres.inputs));
  ASSERT_EQ(drawing.slices.size(), 7u); // three a side
  const SliceContours &middle = drawing.slices[3];
  EXPECT_EQ(middle.index, 0);
  EXPECT_EQ(std::count(middle.truth.begin(), middle.truth.end(), 'M'), 4);
  EXPECT_EQ(std::count(middle.estimates[1].begin(), middle.estimates[1].end(), 'M'), 4);
  EXPECT_EQ(middle.labels.size(), 4u);
}

TEST(WorstPlaces, BeginWithTheLargestDistanceOfTheJudge)
{
  const Spheres spheres({test::sphere_estimate("full", translation, 0.5)});
  const auto places = worst_places(spheres.inputs, truth_surfaces(spheres.truth), nominal_surfaces(spheres.inputs));
  const auto first =
      std::find_if(places.begin(), places.end(), [](const WorstPlace &place) { return place.condition == "full"; });
  double largest = 0;
  for (const runner::StepError &row : spheres.evaluation.by_step)
    if (row.condition == "full" && row.step == spheres.evaluation.n_steps())
      largest = std::max(largest, row.distance.max);
  ASSERT_NE(first, places.end());
  EXPECT_EQ(first->error, largest);
  for (const WorstPlace &a : places)
    for (const WorstPlace &b : places)
      EXPECT_TRUE(&a == &b || a.condition != b.condition || (a.position - b.position).norm() >= 10);
}
} // namespace
} // namespace pelvireg::report
