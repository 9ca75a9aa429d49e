#include "validation/metrics/rigid_rotation.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
dataset::Points centred(const dataset::Points &points)
{
  return points.rowwise() - points.colwise().mean();
}
} // namespace

Eigen::Matrix3d best_rotation(const dataset::Points &from, const dataset::Points &to)
{
  if (from.rows() != to.rows() || from.rows() < 3 || !from.allFinite() || !to.allFinite())
    throw InputError(fmt::format("rotation: got {} and {} points, must be as many, at least three and finite",
                                 from.rows(), to.rows()));
  const Eigen::Matrix3d covariance = centred(from).transpose() * centred(to);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // A plane of points leaves one way to turn, a line infinitely many.
  if (!(svd.singularValues()[1] > 1e-9 * svd.singularValues()[0]))
    throw InputError("rotation: the points lie on a line, so no rotation is best; more of the surface is needed");
  Eigen::Vector3d signs(1, 1, 1);
  if ((svd.matrixV() * svd.matrixU().transpose()).determinant() < 0)
    signs[2] = -1;
  return svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
}

double rotation_angle(const Eigen::Matrix3d &rotation)
{
  // A quaternion's angle is 2 atan2(|vector|, |scalar|): no arc cosine, which would lose half of the digits near zero.
  const Eigen::Quaterniond quaternion(rotation);
  return 2 * std::atan2(quaternion.vec().norm(), std::abs(quaternion.w()));
}
} // namespace pelvireg::metrics
