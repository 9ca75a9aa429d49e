#include "registration/constraints/point_attachment.h"

namespace pelvireg::registration
{
std::vector<HeldNode> hold_nodes(const PointAttachment &attachment, double added_compliance)
{
  std::vector<HeldNode> result;
  for (std::size_t k = 0; k < attachment.nodes.size(); ++k)
    result.push_back({attachment.body, attachment.nodes[k],
                      attachment.points.row(static_cast<Eigen::Index>(k)).transpose(),
                      attachment.compliance + added_compliance});
  return result;
}

Eigen::Vector3d held_gap(const HeldNode &node, const Points &positions)
{
  return positions.row(node.node).transpose() - node.point;
}

void add_held_rows(const HeldNode &node, const Points &positions, ConstraintRows &rows)
{
  const Eigen::Vector3d gap = held_gap(node, positions);
  for (int axis = 0; axis < 3; ++axis)
  {
    rows.add_row(RowKind::attachment, -gap[axis], node.compliance);
    rows.add_entry({node.body, node.node, Eigen::Vector3d::Unit(axis)});
  }
}
} // namespace pelvireg::registration
