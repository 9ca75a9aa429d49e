// The point of a part that a surface term (pressure, cavity, contact, tie, probe) or a bar takes hold of.
#pragma once

#include "reference_fe/term.h"

#include <Eigen/Core>

#include <vector>

namespace pelvireg::reference_fe
{
/// A material point carried by the unknowns of one node.
///
/// Solid node or mid-surface of a shell node: x = R + u (3 unknowns u).
/// Face of a shell node, zeta = side = +1 or -1: x = R + u + h/2 (side + alpha) (N + w) (7 unknowns u, w, alpha).
struct SurfaceNode
{
  int first_unknown = 0; ///< global index of u_x; w and alpha follow
  int side = 0;          ///< +1 outer face, -1 inner face, 0 mid-surface or solid
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();     ///< R, mm (of the mid-surface)
  Eigen::Vector3d director = Eigen::Vector3d::Zero(); ///< N; unused when side is 0
  double half_thickness = 0;                          ///< h/2, mm; unused when side is 0

  int n_unknowns() const { return side == 0 ? 3 : 7; }
  Eigen::Vector3d rest_position() const;
  Eigen::Vector3d position(const Eigen::VectorXd &solution) const;
};

/// Append the unknowns of the nodes, node by node.
void append_unknowns(const std::vector<SurfaceNode> &nodes, std::vector<int> &indices);

/// Positions of the nodes, one column each.
Eigen::Matrix3Xd positions(const std::vector<SurfaceNode> &nodes, const Eigen::VectorXd &solution);

/// Chain rule from nodal positions to unknowns. `force` (3n) and `stiffness` (3n x 3n) are the first and second
/// derivatives with respect to the nodal positions; `n_extra` further rows and columns of the two (a pressure) follow
/// the positions and are passed through. Fills residual and tangent of `local`; the unknowns are in the order of
/// append_unknowns(), then the extra ones. The second derivative of x in (alpha, w) is included: the tangent is exact.
void to_unknowns(const std::vector<SurfaceNode> &nodes, const Eigen::VectorXd &solution, const Eigen::VectorXd &force,
                 const Eigen::MatrixXd &stiffness, int n_extra, LocalSystem &local);
} // namespace pelvireg::reference_fe
