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
  Eigen::Vector3d weights =
      Eigen::Vector3d::Zero(); ///< of the foot in the triangle's plane, which may lie outside; sum 1
  double height = 0;           ///< over the foot, along the triangle's normal, mm
  double least_area =
      0; ///< twice the area below which the height shrinks with the area, mm^2: a flat triangle has no normal
  double compliance = 0; ///< mm/N, each axis
};

/// Bind every node of the attachment to its nearest triangle of body b at rest, with no gap. `walls_of_b` holds the
/// triangles that may carry an attachment, fitted to the rest positions; those without area are passed over. Throws
/// std::invalid_argument when none is left.
std::vector<AttachedNode> bind_attachment(const Attachment &attachment, const std::vector<Body> &bodies,
                                          const TriangleTree &walls_of_b, double added_compliance);

/// x_a - (place over b), mm.
Eigen::Vector3d attachment_gap(const AttachedNode &node, const Points &positions_a, const Points &positions_b);

/// Three rows, one an axis, that close the gap: its derivative. Without gap their forces balance, moments too.
void add_attachment_rows(const AttachedNode &node, const Points &positions_a, const Points &positions_b,
                         ConstraintRows &rows);
} // namespace pelvireg::registration
