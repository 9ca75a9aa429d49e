#include "validation/metrics/surface_distance.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/closest_point.h"
#include "validation/metrics/statistics.h"
#include "validation/metrics/surface_samples.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
using dataset::Points;
using dataset::SurfaceMesh;

std::vector<double> distances_to(const SurfaceMesh &mesh, const Points &samples)
{
  return surface_distances(samples, mesh.points, mesh.triangles, mesh.region);
}

TEST(SurfaceDistance, BetweenConcentricSpheresIsTheDifferenceOfTheRadii)
{
  const SurfaceMesh inner = test::icosphere({1, 2, 3}, 20, 4), outer = test::icosphere({1, 2, 3}, 23, 4);
  const double longest_edge = 20 * 1.2 / 16; // 63.4 deg of the icosahedron's edge, halved four times
  const double sagitta = longest_edge * longest_edge / (2 * 20);
  for (const double distance : distances_to(outer, inner.points))
    EXPECT_NEAR(distance, 3, sagitta);
  for (const double distance : distances_to(inner, outer.points))
    EXPECT_NEAR(distance, 3, 1e-9) << "nodes of both lie on the same rays, and the closest point is a node";
}

TEST(SurfaceDistance, BetweenOffsetPlanesIsTheOffset)
{
  const SurfaceMesh truth = test::square(100, 0, 7), estimate = test::square(100, 2.5, 3);
  const auto samples = sample_surface(truth, 5);
  EXPECT_EQ(samples.size(), 400u);
  for (const double distance : distances_to(estimate, sample_positions(samples, truth.triangles, truth.points)))
    EXPECT_NEAR(distance, 2.5, 1e-12);
}

TEST(SurfaceDistance, OfAPlaneMovedAlongItselfIsZeroInsideAndTheMotionBeyondTheEdge)
{
  const SurfaceMesh mesh = test::square(10, 0, 5);
  Points samples(3, 3);
  samples << 5, 5, 0, 13, 5, 0, 13, 14, 0;
  const auto distances = distances_to(mesh, samples);
  EXPECT_NEAR(distances[0], 0, 1e-14);
  EXPECT_NEAR(distances[1], 3, 1e-14);
  EXPECT_NEAR(distances[2], 5, 1e-14);
}

TEST(SurfaceDistance, TreeAgreesWithTryingEveryTriangle)
{
  const SurfaceMesh mesh = test::ellipsoid({0, 0, 0}, {40, 15, 3}, 3);
  const SurfaceTree tree(mesh.points, mesh.triangles, mesh.region);
  for (int i = 0; i < 200; ++i)
  {
    const Eigen::Vector3d p(60 * std::sin(i * 1.1), 40 * std::sin(i * 1.7), 20 * std::sin(i * 2.3));
    double best = std::numeric_limits<double>::infinity();
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      best = std::min(best, (p - closest_point_on_triangle(p, mesh.points.row(mesh.triangles(t, 0)),
                                                           mesh.points.row(mesh.triangles(t, 1)),
                                                           mesh.points.row(mesh.triangles(t, 2))))
                                .norm());
    EXPECT_EQ(tree.distance(p), best);
  }
}

TEST(SurfaceDistance, ToACapIsNeverMeasured)
{
  SurfaceMesh mesh = test::square(10, 0, 1);
  mesh.region[1] = static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
  Points sample(1, 3);
  sample << 0, 10, 0; // the corner that only the cap has; nearest of the other triangle: (5, 5)
  EXPECT_NEAR(distances_to(mesh, sample)[0], std::sqrt(50), 1e-12);
  mesh.region.setConstant(static_cast<std::int32_t>(dataset::SurfaceRegion::cap));
  EXPECT_THROW(distances_to(mesh, sample), InputError);
}

TEST(SurfaceDistance, DoesNotChangeUnderARigidMotionOfBoth)
{
  SurfaceMesh mesh = test::ellipsoid({0, 0, 0}, {20, 15, 10}, 2);
  Points samples = test::icosphere({1, 1, 1}, 18, 1).points;
  const auto before = distances_to(mesh, samples);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::RowVector3d translation(30, -20, 10);
  mesh.points = (mesh.points * rotation.transpose()).rowwise() + translation;
  samples = (samples * rotation.transpose()).rowwise() + translation;
  const auto after = distances_to(mesh, samples);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(before[i], after[i], 1e-12);
}

TEST(SurfaceDistance, RefusesWhatIsEmptyOrNotFinite)
{
  SurfaceMesh mesh = test::square(10, 0, 1);
  Points sample = Points::Zero(1, 3);
  EXPECT_THROW(distances_to(mesh, Points(0, 3)), InputError);
  EXPECT_THROW(distances_to(SurfaceMesh{}, sample), InputError);
  sample(0, 1) = std::nan("");
  EXPECT_THROW(distances_to(mesh, sample), InputError);
  sample.setZero();
  mesh.points(3, 2) = std::nan("");
  EXPECT_THROW(distances_to(mesh, sample), InputError);
  mesh.points(3, 2) = 0;
  mesh.triangles(0, 0) = 4;
  EXPECT_THROW(distances_to(mesh, sample), InputError);
}
} // namespace
} // namespace pelvireg::metrics
