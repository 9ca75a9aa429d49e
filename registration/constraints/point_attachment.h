// Nodes of one body held at points in space.
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/registration.h"

#include <vector>

namespace pelvireg::registration
{
struct HeldNode
{
  int body = 0, node = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< mm
  double compliance = 0;                           ///< mm/N, each axis
};

std::vector<HeldNode> hold_nodes(const PointAttachment &attachment, double added_compliance);

/// From the point to the node, mm.
Eigen::Vector3d held_gap(const HeldNode &node, const Points &positions);

/// Three rows, one an axis, that close the gap.
void add_held_rows(const HeldNode &node, const Points &positions, ConstraintRows &rows);
} // namespace pelvireg::registration
