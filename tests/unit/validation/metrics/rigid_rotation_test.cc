#include "validation/metrics/rigid_rotation.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
dataset::Points cloud()
{
  dataset::Points points(7, 3);
  points << 1, 2, 3, -4, 0, 2, 7, 1, -1, 0, 0, 0, 3, -5, 2, 2, 2, -6, -1, 8, 4;
  return points;
}

dataset::Points moved(const dataset::Points &points, const Eigen::Matrix3d &turn)
{
  return (points * turn.transpose()).rowwise() + Eigen::RowVector3d(10, -20, 30);
}

TEST(RigidRotation, FindsTheRotationOfARigidMotionToRoundOff)
{
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  for (const double angle : {0.0, 1e-9, 1e-3, 0.7, 2.0, std::numbers::pi - 1e-6, std::numbers::pi})
  {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Eigen::Matrix3d found = best_rotation(cloud(), moved(cloud(), turn));
    EXPECT_LE((found - turn).cwiseAbs().maxCoeff(), 1e-13) << angle;
    EXPECT_NEAR(rotation_angle(found), angle, 1e-13) << angle;
  }
}

TEST(RigidRotation, OfASymmetricStretchIsNone)
{
  const Eigen::Matrix3d frame = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  dataset::Points block(8, 3); // its covariance is a multiple of one, so that every stretch is symmetric about it
  for (int corner = 0; corner < 8; ++corner)
    block.row(corner) << (corner & 1), ((corner >> 1) & 1), (corner >> 2);
  const Eigen::Matrix3d stretch = frame * Eigen::Vector3d(1.5, 0.9, 0.8).asDiagonal() * frame.transpose();
  EXPECT_LE(rotation_angle(best_rotation(block, moved(block, stretch))), 1e-13);
}

TEST(RigidRotation, IsNeverAReflection)
{
  const Eigen::Vector3d mirror(-1, 1, 1);
  const Eigen::Matrix3d found = best_rotation(cloud(), moved(cloud(), mirror.asDiagonal()));
  EXPECT_NEAR(found.determinant(), 1, 1e-12);
}

TEST(RigidRotation, OfAPlaneOfPointsIsFoundToo)
{
  dataset::Points plane = cloud();
  plane.col(2).setZero();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LE((best_rotation(plane, moved(plane, turn)) - turn).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(RigidRotation, RefusesWhatHasNoAnswer)
{
  dataset::Points line = cloud();
  line.col(1) = 2 * line.col(0);
  line.col(2) = -line.col(0);
  EXPECT_THROW(best_rotation(line, line), InputError);
  EXPECT_THROW(best_rotation(dataset::Points::Zero(5, 3), cloud().topRows(5)), InputError);
  EXPECT_THROW(best_rotation(cloud().topRows(2), cloud().topRows(2)), InputError);
  EXPECT_THROW(best_rotation(cloud(), cloud().topRows(3)), InputError);
  dataset::Points broken = cloud();
  broken(2, 2) = std::nan("");
  EXPECT_THROW(best_rotation(broken, cloud()), InputError);
  EXPECT_THROW(best_rotation(cloud(), broken), InputError);
}
} // namespace
} // namespace pelvireg::metrics
