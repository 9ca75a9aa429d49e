#include "validation/metrics/surface_samples.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
using dataset::Points;
using dataset::SurfaceMesh;

TEST(SurfaceSamples, ThereIsOneASquareOfTheSpacing)
{
  const SurfaceMesh sphere = test::icosphere({0, 0, 0}, 25, 4);
  const double expected = 4 * std::numbers::pi * 25 * 25 / 25;
  EXPECT_NEAR(static_cast<double>(sample_surface(sphere, 5).size()), expected, 0.01 * expected);
}

TEST(SurfaceSamples, KeepApartAndLeaveNoHole)
{
  const SurfaceMesh sphere = test::icosphere({0, 0, 0}, 25, 4);
  const Points samples = sample_positions(sample_surface(sphere, 5), sphere.triangles, sphere.points);
  double closest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      closest = std::min(closest, (samples.row(i) - samples.row(j)).norm());
  // One disc each in the densest packing has diameter 5.37 mm; sample elimination reaches about 0.7 of it (Yuksel
  // 2015).
  EXPECT_GE(closest, 0.55 * 5.37);
  for (Eigen::Index i = 0; i < sphere.points.rows(); ++i)
    EXPECT_LE((samples.rowwise() - sphere.points.row(i)).rowwise().norm().minCoeff(), 5.0);
}

TEST(SurfaceSamples, DoNotDependOnHowTheSurfaceIsTriangulated)
{
  // Mean height over the left half of a square: 0.5 exactly; fine cells left, coarse cells right.
  SurfaceMesh mesh = test::square(100, 0, 40);
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
    mesh.points(i, 0) = mesh.points(i, 0) * mesh.points(i, 0) / 100; // cells grow from left to right
  const Points samples = sample_positions(sample_surface(mesh, 5), mesh.triangles, mesh.points);
  const auto n_left = (samples.col(0).array() < 50).count();
  EXPECT_NEAR(static_cast<double>(n_left) / static_cast<double>(samples.rows()), 0.5, 0.02);
}

TEST(SurfaceSamples, AreCarriedByTheNodes)
{
  const SurfaceMesh mesh = test::square(20, 0, 2);
  const auto samples = sample_surface(mesh, 5);
  const Points rest = sample_positions(samples, mesh.triangles, mesh.points);
  // An affine motion is carried exactly.
  Eigen::Matrix3d gradient;
  gradient << 1.1, 0.2, 0, -0.1, 0.9, 0, 0.3, 0.4, 1;
  const Points moved = sample_positions(samples, mesh.triangles, mesh.points * gradient.transpose());
  EXPECT_LE((moved - rest * gradient.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(SurfaceSamples, LeaveCapsOutAndKeepTheCervixPatch)
{
  SurfaceMesh mesh = test::square(20, 0, 1);
  mesh.region[0] = static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
  mesh.region[1] = static_cast<std::int32_t>(dataset::SurfaceRegion::cervix_patch);
  const auto samples = sample_surface(mesh, 5);
  EXPECT_EQ(samples.size(), 8u);
  for (const SurfaceSample &sample : samples)
    EXPECT_EQ(sample.triangle, 1);
}

TEST(SurfaceSamples, AreTheSameOnEveryRun)
{
  const SurfaceMesh mesh = test::ellipsoid({0, 0, 0}, {30, 20, 10}, 3);
  const auto first = sample_surface(mesh, 5), second = sample_surface(mesh, 5);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].triangle, second[i].triangle);
    EXPECT_EQ(first[i].barycentric, second[i].barycentric);
  }
}

TEST(SurfaceSamples, RefuseABadSpacingAndASurfaceWithoutArea)
{
  SurfaceMesh mesh = test::square(20, 0, 1);
  EXPECT_THROW(sample_surface(mesh, 0), InputError);
  EXPECT_THROW(sample_surface(mesh, std::nan("")), InputError);
  mesh.region.setConstant(static_cast<std::int32_t>(dataset::SurfaceRegion::cap));
  EXPECT_THROW(sample_surface(mesh, 5), InputError);
  EXPECT_THROW(sample_surface(SurfaceMesh{}, 5), InputError);
}
} // namespace
} // namespace pelvireg::metrics
