// Anatomical constraints chi: nodes of one body held on the surface of another (paper, section 5.1, equation 6).
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/constraints/triangle_tree.h"
#include "registration/registration.h"

#include <vector>

namespace pelvireg::registration
{
/// A node of body a and the place over a triangle of body b that carries it. The two meshes need not match. The place
/// deforms with the triangle in its plane and keeps its height over it, so it turns with the triangle and does not
/// depend on the order of its nodes.
struct AttachedNode
{
  int body_a = 0, node_a = 0;
  int body_b = 0;
  Eigen::Vector3i nodes_b = Eigen::Vector3i::Zero();
  /// Of the foot in the triangle's plane, which may lie outside the triangle; sum 1.
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  double height = 0; ///< over the foot, along the triangle's normal, mm
  /// Twice the area, mm^2, below which the height shrinks with the area: a flat triangle has no normal.
  double least_area = 0;
  double compliance = 0; ///< mm/N, each axis
};

/// Bind every node of the attachment to its nearest triangle of body b at rest, with no gap. `walls_of_b` holds the
/// triangles that may carry an attachment, fitted to the rest positions; needles are passed over. Throws
/// std::invalid_argument when none is left.
std::vector<AttachedNode> bind_attachment(const Attachment &attachment, const std::vector<Body> &bodies,
                                          const TriangleTree &walls_of_b, double added_compliance);

/// x_a - (place over b), mm.
Eigen::Vector3d attachment_gap(const AttachedNode &node, const Points &positions_a, const Points &positions_b);

/// Three rows, one an axis, that close the gap; their Jacobian is its derivative. When it is closed, the forces on both
/// bodies balance in force and moment.
void add_attachment_rows(const AttachedNode &node, const Points &positions_a, const Points &positions_b,
                         ConstraintRows &rows);
} // namespace pelvireg::registration
