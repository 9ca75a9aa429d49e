// Corotational trilinear hexahedron with condensed incompatible modes.
#pragma once

#include "registration/elements/elasticity.h"

#include <Eigen/Core>

namespace pelvireg::registration
{
/// Eight nodes in VTK order, 2 x 2 x 2 Gauss points. The nine incompatible modes of Taylor, Beresford & Wilson (IJNME
/// 10, 1976), condensed at rest, keep a band of one element across from locking in bending and at nu = 0.45; they cost
/// nothing in a step, because the stiffness of the element frame is constant.
class Hexahedron
{
public:
  static constexpr int n_nodes = 8;
  using NodalVectors = Eigen::Matrix<double, 3, n_nodes>; ///< column a belongs to node a
  using Stiffness = Eigen::Matrix<double, 3 * n_nodes, 3 * n_nodes>;

  /// Rest positions in mm. The least Jacobian must be positive (see least_jacobian()): the caller checks.
  Hexahedron(const NodalVectors &rest, const Lame &material);

  /// Least determinant of the Jacobian over the corners, mm^3 (of the reference cube of edge 2).
  static double least_jacobian(const NodalVectors &rest);

  double volume() const { return volume_shares_.sum(); }

  /// Integral of shape function a, mm^3 (lumped mass = density x share).
  double volume_share(int a) const { return volume_shares_[a]; }

  /// Rotation of the deformation gradient at the element's centre.
  Eigen::Matrix3d rotation(const NodalVectors &positions) const;

  /// Gradient of the elastic energy, R K (R^T x - X), N.
  NodalVectors force(const Eigen::Matrix3d &rotation, const NodalVectors &positions) const;

  /// The rotation itself: what stiffness_block() reads.
  Eigen::Matrix3d rotated_stiffness(const Eigen::Matrix3d &rotation) const { return rotation; }

  /// Block (a, b) of R K R^T, N/mm.
  Eigen::Matrix3d stiffness_block(const Eigen::Matrix3d &rotation, int a, int b) const
  {
    return rotation * stiffness_.block<3, 3>(3 * a, 3 * b) * rotation.transpose();
  }

  /// Geometric stiffness of what the element carries in tension, N/mm: block (a, b) is entry (a, b) times the unit
  /// matrix. R K R^T has none, so that Newton's method swings a taut band about its line for ever, wider and wider, as
  /// soon as the tension holds it more firmly than its bending stiffness. Compression is left out: it would take
  /// definiteness away.
  Eigen::Matrix<double, n_nodes, n_nodes> tension_stiffness(const Eigen::Matrix3d &rotation,
                                                            const NodalVectors &positions) const;

  /// Stiffness of the element frame, N/mm.
  const Stiffness &stiffness() const { return stiffness_; }

private:
  NodalVectors rest_;
  Lame material_;
  NodalVectors centre_gradients_; ///< of the shape functions at the centre, 1/mm
  Eigen::Matrix<double, n_nodes, 1> volume_shares_;
  Stiffness stiffness_;
};
} // namespace pelvireg::registration
