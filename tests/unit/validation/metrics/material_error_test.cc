#include "validation/metrics/material_error.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/surface_distance.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
TEST(MaterialError, OfATranslationIsItsLengthItsNormalAndItsTangentialPart)
{
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  dataset::SurfaceMesh square = test::square(50, 0, 5);
  square.points = (square.points * turn.transpose()).eval();
  const auto samples = sample_surface(square, 5);
  const dataset::Points normals = sample_normals(samples, square.triangles, square.points);
  const Eigen::Vector3d error = turn * Eigen::Vector3d(3, 0, -4);
  const MaterialError found = material_error(error.transpose().replicate(normals.rows(), 1), normals);
  EXPECT_EQ(found.distance.n, 100);
  EXPECT_NEAR(found.distance.mean, 5, 1e-13);
  EXPECT_NEAR(found.distance.p95, 5, 1e-13);
  EXPECT_NEAR(found.normal_mean, 4, 1e-13);
  EXPECT_NEAR(found.tangential_mean, 3, 1e-13);
}

TEST(MaterialError, SeesASurfaceThatSlidesAlongItselfWhereSurfaceDistanceIsBlind)
{
  // A ball that turns by 0.3 rad about z: its surface stays where it is, its points do not.
  const dataset::SurfaceMesh ball = test::icosphere({5, -3, 8}, 30, 4);
  const auto samples = sample_surface(ball, 5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  dataset::Points turned = ball.points;
  for (Eigen::Index i = 0; i < turned.rows(); ++i)
    turned.row(i) = Eigen::Vector3d(5, -3, 8) + turn * (ball.points.row(i).transpose() - Eigen::Vector3d(5, -3, 8));
  const dataset::Points truth = sample_positions(samples, ball.triangles, ball.points);
  const MaterialError found = material_error(sample_positions(samples, ball.triangles, turned) - truth,
                                             sample_normals(samples, ball.triangles, ball.points));
  // |e| = 2 sin(0.15) rho, and the mean of rho over a sphere is pi r / 4.
  EXPECT_NEAR(found.distance.mean, 2 * std::sin(0.15) * EIGEN_PI * 30 / 4, 0.02);
  EXPECT_NEAR(found.distance.max, 2 * std::sin(0.15) * 30, 0.03);
  EXPECT_LE(found.normal_mean, 0.15 * found.distance.mean)
      << "chords of 0.3 rad leave the sphere by 0.15 of their length";
  EXPECT_LE(describe(surface_distances(truth, turned, ball.triangles, ball.region)).mean, 0.1);
}

TEST(MaterialError, RefusesWhatHasNoAnswer)
{
  const dataset::Points one = dataset::Points::Ones(2, 3);
  EXPECT_THROW(material_error(dataset::Points(0, 3), dataset::Points(0, 3)), InputError);
  EXPECT_THROW(material_error(one, dataset::Points::Ones(1, 3)), InputError);
  dataset::Points broken = one;
  broken(1, 2) = std::nan("");
  EXPECT_THROW(material_error(broken, one), InputError);
  EXPECT_THROW(material_error(one, broken), InputError);
  dataset::SurfaceMesh flat = test::square(1, 0, 1);
  flat.points.row(3) = flat.points.row(0);
  EXPECT_THROW(sample_normals({{0, {1, 0, 0}}}, flat.triangles, flat.points), InputError);
}
} // namespace
} // namespace pelvireg::metrics
