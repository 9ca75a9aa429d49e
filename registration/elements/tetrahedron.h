// Corotational linear tetrahedron (paper, equations 1 to 3).
#pragma once

#include "registration/elements/elasticity.h"

#include <Eigen/Core>

namespace pelvireg::registration
{
/// The strain is constant, so the element needs no stored stiffness: the shape gradients give force and stiffness.
class Tetrahedron
{
public:
  static constexpr int n_nodes = 4;
  using NodalVectors = Eigen::Matrix<double, 3, n_nodes>; ///< column a belongs to node a

  /// Rest positions in mm. The volume must be positive (see volume()): the caller checks.
  Tetrahedron(const NodalVectors &rest, const Lame &material);

  /// mm^3, negative when the element is inverted at rest.
  double volume() const { return volume_; }

  /// Gradients of the shape functions at rest, 1/mm; column a belongs to node a.
  const NodalVectors &gradients() const { return gradients_; }

  /// Share of the volume that node a carries, mm^3 (lumped mass = density x share).
  double volume_share(int) const { return volume_ / n_nodes; }

  /// Rotation of the constant deformation gradient.
  Eigen::Matrix3d rotation(const NodalVectors &positions) const;

  /// Gradient of the elastic energy, R K (R^T x - X), N.
  NodalVectors force(const Eigen::Matrix3d &rotation, const NodalVectors &positions) const;

  /// Gradients of the shape functions turned by the rotation: what stiffness_block() reads.
  NodalVectors rotated_stiffness(const Eigen::Matrix3d &rotation) const { return rotation * gradients_; }

  /// Block (a, b) of R K R^T, N/mm.
  Eigen::Matrix3d stiffness_block(const NodalVectors &turned, int a, int b) const;

private:
  NodalVectors gradients_; ///< of the shape functions, 1/mm
  Lame material_;
  double volume_ = 0;
};
} // namespace pelvireg::registration
