#include "validation/metrics/outline_error.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
using dataset::Points;

constexpr double radius = 20;
const dataset::Plane plane{{0, 0, 0}, {1, 0, 0}};
// icosphere(…, 5): edges of 1.2 / 32 radii; a chord of such an edge lies at most edge^2 / (8 R) inside the sphere
constexpr double sagitta = 20 * (1.2 / 32) * (1.2 / 32) / 8;

dataset::SurfaceMesh sphere()
{
  return test::icosphere({0, 0, 0}, radius, 5);
}

Points circle(double r, int n = 400)
{
  Points points(n, 3);
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / n;
    points.row(i) << 0, r * std::cos(angle), r * std::sin(angle);
  }
  return points;
}

Points turned(const Points &points, double angle)
{
  return points * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose();
}

TEST(OutlineError, OfTheTruthItselfIsNil)
{
  const dataset::SurfaceMesh rest = sphere();
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  const auto error = truth.error(rest.points, {circle(radius)});
  EXPECT_EQ(error.n_points, 400);
  EXPECT_LT(error.mean, sagitta);
  EXPECT_LT(error.hd95, 2 * sagitta);
  EXPECT_LT(error.normal, sagitta);
  EXPECT_LT(error.tangential, 2 * sagitta);
}

TEST(OutlineError, OfAWiderOutlineIsItsDistanceAndNoDrift)
{
  const dataset::SurfaceMesh rest = sphere();
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  const auto error = truth.error(rest.points, {circle(radius + 1.5)});
  EXPECT_NEAR(error.mean, 1.5, 2 * sagitta);
  EXPECT_NEAR(error.hd95, 1.5, 2 * sagitta);
  EXPECT_NEAR(error.normal, 1.5, 2 * sagitta);
  EXPECT_LT(error.tangential, 0.05); // the normal of a facet is not that of the sphere
}

TEST(OutlineError, OfAnOutlineThatSlidesIsTangentialAlone)
{
  const dataset::SurfaceMesh rest = sphere();
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  const double angle = 0.15; // the truth turns under an outline that stays
  const auto error = truth.error(turned(rest.points, angle), {circle(radius)});
  EXPECT_LT(error.mean, 2 * sagitta);
  EXPECT_LT(error.normal, 2 * sagitta);
  EXPECT_NEAR(error.tangential, radius * std::sin(angle), 0.05); // chord 2 R sin(a/2), at a/2 to the tangent
}

TEST(OutlineError, OfAMoveOutOfThePlaneSeesTheSectionThatIsThere)
{
  const dataset::SurfaceMesh rest = sphere();
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  Points moved = rest.points;
  moved.col(0).array() += 12; // the plane now cuts a circle of radius 16
  const auto error = truth.error(moved, {circle(16)});
  EXPECT_LT(error.mean, 0.06); // slope 12/16 of the surface against the plane enlarges the sagitta
  EXPECT_LT(error.normal, 0.06);
  EXPECT_LT(error.tangential, 0.06);
}

TEST(OutlineError, DoesNotScoreCapsAndTheCervixPatch)
{
  dataset::SurfaceMesh rest = sphere();
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t)
  {
    const double z = (rest.points(rest.triangles(t, 0), 2) + rest.points(rest.triangles(t, 1), 2) +
                      rest.points(rest.triangles(t, 2), 2)) /
                     3;
    if (std::abs(z) > 10)
      rest.region[t] =
          static_cast<std::int32_t>(z > 0 ? dataset::SurfaceRegion::cap : dataset::SurfaceRegion::cervix_patch);
  }
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  Points tracked = circle(radius);
  for (Eigen::Index i = 0; i < tracked.rows(); ++i)
    if (std::abs(tracked(i, 2)) > 11.5)
      tracked.row(i) *= 2; // wrong where nothing is scored
  const auto error = truth.error(rest.points, {tracked});
  EXPECT_LT(error.mean, 0.05);
  EXPECT_LT(error.normal, 0.05);
  EXPECT_NEAR(error.n_points, 400.0 / 3, 10); // |z| < R/2: a third of the circle
}

TEST(OutlineError, RefusesWhatIsNotTheOutlineItStartedFrom)
{
  const dataset::SurfaceMesh rest = sphere();
  EXPECT_THROW(OutlineTruth(rest, {circle(radius + 3)}, plane), InputError);
  const OutlineTruth truth(rest, {circle(radius)}, plane);
  EXPECT_THROW(truth.error(rest.points, {circle(radius, 399)}), InputError);
  EXPECT_THROW(truth.error(rest.points, {}), InputError);
  Points broken = circle(radius);
  broken(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(truth.error(rest.points, {broken}), InputError);
  Points away = rest.points;
  away.col(0).array() += 50;
  EXPECT_THROW(truth.error(away, {circle(radius)}), InputError);
}

TEST(InterpolatedPositions, AreLinearBetweenIncrementsAndMeetThem)
{
  const dataset::SurfaceMesh rest = test::square(10, 0, 1);
  std::vector<Points> displacements(2, Points::Zero(rest.points.rows(), 3));
  displacements[0].col(2).setConstant(3);
  displacements[1].col(2).setConstant(9);
  const std::vector<std::pair<double, double>> expected = {{0, 0}, {0.5, 1.5}, {1, 3}, {1.5, 6}, {2, 9}};
  for (const auto &[increments, height] : expected)
    EXPECT_DOUBLE_EQ(interpolated_positions(rest, displacements, increments)(0, 2), height);
  EXPECT_THROW(interpolated_positions(rest, displacements, 2.1), InputError);
  EXPECT_THROW(interpolated_positions(rest, displacements, -0.1), InputError);
}
} // namespace
} // namespace pelvireg::metrics
