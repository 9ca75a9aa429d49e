// The motion of one node's material fibre of the 7-parameter shell: x(zeta) = r + (h/2)(zeta + alpha zeta^2) d.
#pragma once

#include <Eigen/Core>

namespace pelvireg::reference_fe
{
/// Unknowns of a shell node, in this order: u (3, mm), w (3, change of the director), alpha (1).
/// Node n of a body whose first unknown is f owns the unknowns f + 7 n … f + 7 n + 6.
inline constexpr int n_shell_unknowns = 7;
using ShellNodeUnknowns = Eigen::Matrix<double, n_shell_unknowns, 1>;

/// Rest geometry of a shell node.
struct ShellNode
{
  Eigen::Vector3d midsurface = Eigen::Vector3d::Zero(); ///< R, mm
  Eigen::Vector3d director = Eigen::Vector3d::UnitZ();  ///< N, unit outward normal
  double half_thickness = 0;                            ///< h/2, mm
};

/// x(zeta), mm; zeta = -1 inner, +1 outer surface. Between nodes the outer surface of a cell is represented by its
/// nodal outer points and the cell's shape functions.
inline Eigen::Vector3d shell_point(const ShellNode &node, const ShellNodeUnknowns &q, double zeta)
{
  const double fibre = node.half_thickness * (zeta + q[6] * zeta * zeta);
  return node.midsurface + q.head<3>() + fibre * (node.director + q.segment<3>(3));
}

/// dx/dq, 3 x 7: [ I, fibre I, (h/2) zeta^2 d ].
inline Eigen::Matrix<double, 3, n_shell_unknowns> shell_point_gradient(const ShellNode &node,
                                                                       const ShellNodeUnknowns &q, double zeta)
{
  Eigen::Matrix<double, 3, n_shell_unknowns> gradient;
  gradient.leftCols<3>().setIdentity();
  gradient.middleCols<3>(3) = node.half_thickness * (zeta + q[6] * zeta * zeta) * Eigen::Matrix3d::Identity();
  gradient.col(6) = node.half_thickness * zeta * zeta * (node.director + q.segment<3>(3));
  return gradient;
}

/// Hessian of force . x(zeta) with respect to q, 7 x 7: only the pairs (w_k, alpha) are not zero.
inline Eigen::Matrix<double, n_shell_unknowns, n_shell_unknowns> shell_point_hessian(const ShellNode &node, double zeta,
                                                                                     const Eigen::Vector3d &force)
{
  Eigen::Matrix<double, n_shell_unknowns, n_shell_unknowns> hessian;
  hessian.setZero();
  hessian.block<3, 1>(3, 6) = node.half_thickness * zeta * zeta * force;
  hessian.block<1, 3>(6, 3) = hessian.block<3, 1>(3, 6).transpose();
  return hessian;
}
} // namespace pelvireg::reference_fe
