// The extended motion and the walls against closed forms.
#include "synthetic/observation/images/motion_field.h"
#include "tests/unit/observation/images/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::observation::test
{
namespace
{
/// A flat wall in z = 0, half a metre wide, that moves by (0, 2, -1).
MovedPoints moving_wall()
{
  constexpr double step = 2, half = 300;
  MovedPoints wall;
  const int n = static_cast<int>(2 * half / step) + 1;
  wall.rest.resize(n * n, 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      wall.rest.row(i * n + j) << i * step - half, j * step - half - 2, 1; // rest; moved it lies in z = 0
  wall.displacements.resize(n * n, 3);
  wall.displacements.rowwise() = Eigen::RowVector3d(0, 2, -1);
  wall.areas = Eigen::VectorXd::Constant(n * n, step * step);
  return wall;
}
} // namespace

TEST(ExtendedMotion, FadesFromAFlatWallAsItsKernelSays)
{
  const MovedPoints wall = moving_wall();
  for (const double height : {5.0, 10.0, 25.0, 40.0})
  {
    // The kernel's integral over the plane is pi / (h^2 + e^2), e = 1.5 mm; the wall ends at 300 mm: below 1 %.
    const double share = 1 / (1 + (height * height + 2.25) / (motion_reach * motion_reach));
    EXPECT_NEAR(extended_displacement(wall, {3, 4, height}, true).y(), 2 * share, 0.02) << height;
    EXPECT_NEAR(extended_displacement(wall, {3, 4, height}, false).y(), 2, 1e-12);
  }
}

TEST(MotionField, OfARigidMotionIsExactEverywhereAndInBetween)
{
  TissueBody ball = solid_ball(20, {0, 0, 0});
  translate(ball, {0.5, 2, -1});
  const dataset::ImageGeometry geometry = sagittal(64, 1.5, {0, 0, 0});
  const MotionField rest(geometry, 5, moved_points(ball, 0), false), moved(geometry, 5, moved_points(ball, 1), false);
  const Vector3d inside = MotionField::between(rest, moved, 0.3).displacement_at({1, 7.7, -3.3});
  EXPECT_LT((inside - 0.3 * Vector3d(0.5, 2, -1)).norm(), 1e-12);
  EXPECT_LT((moved.displacement_at({1, 400, -3.3}) - Vector3d(0.5, 2, -1)).norm(), 1e-12); // held beyond
}

TEST(Wall, OfABallEndsOneThicknessInside)
{
  const TissueBody ball = hollow_ball(Tissue::bladder, 20, 3, {0, 0, 0});
  const dataset::SurfaceMesh inner = inner_surface(ball, 0);
  for (Eigen::Index i = 0; i < inner.points.rows(); ++i)
    EXPECT_NEAR(inner.points.row(i).norm(), 17, 0.01);
}

TEST(Wall, ThinsAsItStretchesSoThatItsVolumeStays)
{
  TissueBody ball = hollow_ball(Tissue::bladder, 20, 0.5, {0, 0, 0});
  ball.displacements.push_back(0.1 * ball.rest.points); // radius 22
  const dataset::SurfaceMesh inner = inner_surface(ball, 1);
  // Thin wall: 4 pi R^2 t stays, t = 0.5 / 1.21.
  EXPECT_NEAR(inner.points.row(0).norm(), 22 - 0.5 / 1.21, 0.002);
}

TEST(Wall, IsOpenWhereATubeIsCapped)
{
  TissueBody tube = body_of("rectum", Tissue::rectum, capped_tube(10, 50, 40, 20));
  tube.wall = Eigen::VectorXd::Constant(tube.rest.points.rows(), 2);
  const dataset::SurfaceMesh inner = inner_surface(tube, 0);
  // Rim nodes move to the side, not along the tube: the lumen reaches the caps.
  EXPECT_NEAR(inner.points.col(2).minCoeff(), tube.rest.points.col(2).minCoeff(), 1e-9);
  EXPECT_NEAR(inner.points.col(2).maxCoeff(), tube.rest.points.col(2).maxCoeff(), 1e-9);
}
} // namespace pelvireg::observation::test
