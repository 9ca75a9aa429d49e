// Anatomical constraints chi: nodes of one body held on the surface of another (paper, section 5.1, equation 6).
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/constraints/triangle_tree.h"
#include "registration/registration.h"

#include <vector>

namespace pelvireg::registration
{
/// A node of body a and the material point of body b that carries it. The two meshes need not match.
struct AttachedNode
{
  int body_a = 0, node_a = 0;
  int body_b = 0;
  Eigen::Vector3i nodes_b = Eigen::Vector3i::Zero();
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  Eigen::Vector3d rest_offset = Eigen::Vector3d::Zero(); ///< x_a - (point of b) at rest, mm: rest stays free of force
  double compliance = 0;                                 ///< mm/N, each axis
};

/// Bind every node of the attachment to its nearest triangle of body b at rest. `walls_of_b` holds the triangles that
/// may carry an attachment, fitted to the rest positions, and must not be empty.
std::vector<AttachedNode> bind_attachment(const Attachment &attachment, const std::vector<Body> &bodies,
                                          const TriangleTree &walls_of_b, double added_compliance);

/// x_a - (point of b) - rest offset, mm.
Eigen::Vector3d attachment_gap(const AttachedNode &node, const Points &positions_a, const Points &positions_b);

/// Three rows, one an axis, that close the gap.
void add_attachment_rows(const AttachedNode &node, const Points &positions_a, const Points &positions_b,
                         ConstraintRows &rows);
} // namespace pelvireg::registration
