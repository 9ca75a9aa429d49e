// What the judge measures beyond surface distance, on a whole case whose answers are known.
#include "tests/unit/validation/fixtures/shapes.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/evaluate.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

namespace pelvireg::runner
{
namespace
{
const Eigen::Vector3d translation(2, 3, -6);
constexpr int last_step = test::n_increments * test::steps_per_increment;

Evaluation judged(const dataset::Estimate &estimate)
{
  return evaluate(test::sphere_anatomy(), test::sphere_truth(translation), {estimate});
}

std::vector<StepMetrics> last_rows(const Evaluation &evaluation, const std::string &condition)
{
  std::vector<StepMetrics> rows;
  for (const StepMetrics &row : evaluation.metrics_by_step)
    if (row.condition == condition && row.step == last_step)
      rows.push_back(row);
  return rows;
}

/// A perfect estimate whose organs are then changed at the last step: each point of organ i by `change` in the organ's
/// own frame, whose origin is the centre of the moved organ.
dataset::Estimate changed(const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &change)
{
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1);
  for (std::size_t organ = 0; organ < 4; ++organ)
  {
    const Eigen::Vector3d centre = Eigen::Vector3d(0.37, 0, 100.0 * static_cast<double>(organ)) + translation;
    dataset::Points &positions = estimate.samples[0].surfaces[organ].positions.back();
    for (Eigen::Index node = 0; node < positions.rows(); ++node)
      positions.row(node) = centre + change(positions.row(node).transpose() - centre);
  }
  return estimate;
}

TEST(JudgeMetrics, APerfectEstimateIsPerfectInAll)
{
  const Evaluation evaluation = judged(test::sphere_estimate("full", translation, 1));
  ASSERT_EQ(evaluation.metrics_by_step.size(), 2u * 4u * 3u) << "unregistered and full, organs, positions";
  const auto rows = last_rows(evaluation, "full");
  ASSERT_EQ(rows.size(), 4u);
  for (const StepMetrics &row : rows)
  {
    EXPECT_LE(row.material.distance.max, 1e-12);
    EXPECT_LE(row.symmetric.hd95, 1e-12);
    EXPECT_NEAR(row.dice, 1, 1e-12);
    EXPECT_NEAR(row.volume / row.rest_volume, 1, 1e-12);
    EXPECT_NEAR(row.truth_volume / row.truth_rest_volume, 1, 1e-12);
    EXPECT_LE(row.rotation_error, 1e-12);
    EXPECT_LE(row.truth_rotation, 1e-12);
  }
}

TEST(JudgeMetrics, MaterialErrorOfDoingNothingIsTheMotionItself)
{
  const Evaluation evaluation = judged(test::sphere_estimate("full", translation, 0.5));
  for (const StepMetrics &row : evaluation.metrics_by_step)
  {
    const double motion = 7.0 * row.step / last_step;
    EXPECT_NEAR(row.material.distance.mean, row.condition == unregistered ? motion : motion / 2, 1e-12);
    EXPECT_NEAR(row.material.distance.max, row.condition == unregistered ? motion : motion / 2, 1e-12);
    EXPECT_LT(row.symmetric.mean, row.material.distance.mean);
    EXPECT_LT(row.dice, 1);
    EXPECT_LE(row.rotation_error, 1e-12);
  }
}

TEST(JudgeMetrics, ARotationIsFoundWithItsAngle)
{
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  for (const StepMetrics &row : last_rows(judged(changed([&](const auto &p) { return turn * p; })), "full"))
  {
    EXPECT_NEAR(row.rotation_error, 0.2, 1e-12) << row.organ;
    EXPECT_NEAR(row.volume / row.rest_volume, 1, 1e-12);
    EXPECT_GT(row.material.tangential_mean, row.material.normal_mean);
    EXPECT_GT(row.material.distance.mean, 1.5 * row.symmetric.mean) << "what surface distance hides";
  }
}

TEST(JudgeMetrics, AShrunkOrganHasLostItsVolumeAndItsShareOfDice)
{
  const double volume = 0.9 * 0.9 * 0.9;
  for (const StepMetrics &row : last_rows(judged(changed([](const auto &p) { return 0.9 * p; })), "full"))
  {
    EXPECT_NEAR(row.volume / row.rest_volume, volume, 1e-12);
    EXPECT_NEAR(row.truth_volume / row.truth_rest_volume, 1, 1e-12);
    EXPECT_NEAR(row.dice, 2 * volume / (1 + volume), 2e-3);
    EXPECT_LE(row.rotation_error, 1e-12);
  }
}

TEST(JudgeMetrics, ErrorAgainstDistanceFollowsAnErrorThatGrowsWithIt)
{
  // Sheared along the plane by a tenth of the distance from it: the material points' error is exactly that.
  const Eigen::Vector3d centre = Eigen::Vector3d(0.37, 0, 0) + translation; // the plane is x = 0
  const Evaluation evaluation =
      judged(changed([&](const auto &p) { return Eigen::Vector3d(p.x(), p.y() + 0.1 * (p.x() + centre.x()), p.z()); }));
  int n = 0;
  double weighted = 0;
  for (const DistanceError &row : evaluation.by_distance)
  {
    if (row.condition != "full" || row.organ != "vagina")
      continue;
    n += row.distance.n;
    weighted += row.distance.n * row.material_mean;
    const double middle = 0.1 * 6 * std::abs(row.bin);
    EXPECT_LE(std::abs(row.material_mean - middle), 0.3) << "within half a slab";
    EXPECT_LE(row.distance.mean, row.material_mean);
  }
  const StepMetrics vagina = last_rows(evaluation, "full")[1];
  EXPECT_EQ(n, vagina.material.distance.n) << "every sample in one slab";
  EXPECT_NEAR(weighted / n, vagina.material.distance.mean, 1e-12);
}

TEST(JudgeMetrics, ARunWithItsOwnRestSurfaceIsAskedThere)
{
  // Moved 1 mm at rest and carried exactly: the surface is 1 mm off, the displacement of the material is right.
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1);
  for (dataset::EstimateSurface &surface : estimate.samples[0].surfaces)
  {
    surface.rest.points.col(1).array() += 1;
    for (dataset::Points &positions : surface.positions)
      positions.col(1).array() += 1;
  }
  for (const StepMetrics &row : last_rows(judged(estimate), "full"))
  {
    EXPECT_LE(row.material.distance.max, 1e-12);
    EXPECT_GT(row.symmetric.mean, 0.3);
  }
}

TEST(JudgeMetrics, SectionsOfAnEllipsoidShrinkWithTheSquareOfTheDistance)
{
  const Evaluation evaluation = judged(test::sphere_estimate("full", translation, 1));
  // Centre 2.37 mm to the left, half axis 20 mm: slices -2 ... 3 cut it.
  const auto section = [](int k) { return 1 - std::pow((6 * k - 2.37) / 20, 2); };
  int n = 0;
  for (const TruthSection &found : evaluation.sections)
    if (found.organ == "uterus")
    {
      ++n;
      EXPECT_NEAR(found.area, std::numbers::pi * 18 * 15 * section(found.slice_index), 12);
      EXPECT_NEAR(found.share, section(found.slice_index) / section(0), 0.01);
      EXPECT_EQ(counts_for_growth(evaluation, "uterus", found.slice_index),
                section(found.slice_index) > section(0) / 2);
    }
  EXPECT_EQ(n, 6);
  EXPECT_FALSE(counts_for_growth(evaluation, "uterus", -3)) << "the plane misses it";
}

TEST(JudgeMetrics, OrgansInEachOtherHaveTheVolumeOfTheirLens)
{
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1);
  const dataset::SurfaceMesh sphere = test::icosphere({0, 0, 0}, 15, 3);
  for (const auto &[organ, z] : {std::pair<std::size_t, double>{1, 100.0}, {2, 126.0}}) // 4 mm in each other
    estimate.samples[0].surfaces[organ].positions.back() = sphere.points.rowwise() + Eigen::RowVector3d(0, 0, z);
  const double lens = std::numbers::pi * 16 * (26 * 26 + 2 * 26 * 30) / (12 * 26);
  for (const OrganPenetration &pair : judged(estimate).penetrations)
  {
    const bool is_lens = pair.condition == "full" && pair.organ_a == "vagina" && pair.organ_b == "uterus";
    EXPECT_NEAR(pair.last_volume, is_lens ? lens : 0, 0.05 * lens) << pair.organ_a << pair.organ_b;
    EXPECT_EQ(pair.largest_volume, pair.last_volume);
  }
}

TEST(JudgeMetrics, ElementsAreThoseOfTheBodiesThatTheEstimateKeeps)
{
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::RegistrationBody ligaments;
  ligaments.name = "ligaments";
  ligaments.points.resize(5, 3);
  ligaments.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1;
  ligaments.tets.resize(2, 4);
  ligaments.tets << 0, 1, 2, 3, 0, 2, 1, 4;
  anatomy.registration.bodies.push_back(ligaments);
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1);
  dataset::BodyNodes nodes{"ligaments", ligaments.points, 2 * ligaments.points};
  nodes.last(4, 2) = 0.5; // past the base
  estimate.samples[0].bodies = {nodes};
  const Evaluation evaluation = evaluate(anatomy, test::sphere_truth(translation), {estimate});
  ASSERT_EQ(evaluation.elements.size(), 1u);
  EXPECT_EQ(evaluation.elements[0].body, "ligaments");
  EXPECT_EQ(evaluation.elements[0].jacobian.n_elements, 2);
  EXPECT_EQ(evaluation.elements[0].jacobian.n_inverted, 1);
  EXPECT_NEAR(evaluation.elements[0].jacobian.smallest, -2, 1e-14);
  EXPECT_EQ(evaluation.n_registration_nodes(), 4 * 643 + 5);
}

TEST(JudgeMetrics, SaysWhenTheRegistrationMadeTheTruth)
{
  dataset::Truth truth = test::sphere_truth(translation);
  EXPECT_FALSE(evaluate(test::sphere_anatomy(), truth, {}).is_inverse_crime);
  truth.source = dataset::truth_of_registration + ", condition full, of case t005_large";
  EXPECT_TRUE(evaluate(test::sphere_anatomy(), truth, {}).is_inverse_crime);
  truth.source = "imported; not a " + dataset::truth_of_registration;
  EXPECT_FALSE(evaluate(test::sphere_anatomy(), truth, {}).is_inverse_crime);
}
} // namespace
} // namespace pelvireg::runner
