#include "registration/elements/tetrahedron.h"

#include "registration/elements/rotation.h"

#include <Eigen/Dense>

namespace pelvireg::registration
{
Tetrahedron::Tetrahedron(const NodalVectors &rest, const Lame &material) : material_(material)
{
  Eigen::Matrix3d edges;
  for (int a = 0; a < 3; ++a)
    edges.col(a) = rest.col(a + 1) - rest.col(0);
  volume_ = edges.determinant() / 6;
  gradients_.rightCols<3>() = edges.inverse().transpose();
  gradients_.col(0) = -gradients_.rightCols<3>().rowwise().sum();
}

Eigen::Matrix3d Tetrahedron::rotation(const NodalVectors &positions) const
{
  return rotation_of(positions * gradients_.transpose());
}

Tetrahedron::NodalVectors Tetrahedron::force(const Eigen::Matrix3d &rotation, const NodalVectors &positions) const
{
  const Eigen::Matrix3d stretch = rotation.transpose() * (positions * gradients_.transpose());
  const Eigen::Matrix3d strain = 0.5 * (stretch + stretch.transpose()) - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d stress =
      material_.lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2 * material_.mu * strain;
  return volume_ * (rotation * stress) * gradients_;
}

Eigen::Matrix3d Tetrahedron::stiffness_block(const NodalVectors &turned, int a, int b) const
{
  const auto ga = turned.col(a);
  const auto gb = turned.col(b);
  Eigen::Matrix3d block = volume_ * material_.lambda * (ga * gb.transpose());
  block.noalias() += volume_ * material_.mu * (gb * ga.transpose());
  block.diagonal().array() += volume_ * material_.mu * ga.dot(gb);
  return block;
}
} // namespace pelvireg::registration
