#include "registration/constraints/attachment.h"

#include <limits>

namespace pelvireg::registration
{
namespace
{
Eigen::Vector3d point_of_b(const AttachedNode &node, const Points &positions_b)
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    point += node.weights[i] * positions_b.row(node.nodes_b[i]).transpose();
  return point;
}
} // namespace

std::vector<AttachedNode> bind_attachment(const Attachment &attachment, const std::vector<Body> &bodies,
                                          const TriangleTree &walls_of_b, double added_compliance)
{
  const Points &rest_a = bodies[attachment.body_a].rest_positions;
  const Points &rest_b = bodies[attachment.body_b].rest_positions;
  std::vector<AttachedNode> result;
  for (const int node_a : attachment.nodes_a)
  {
    const Eigen::Vector3d position = rest_a.row(node_a).transpose();
    const NearestTriangle nearest =
        walls_of_b.nearest(position, std::numeric_limits<double>::infinity(), rest_b, [](int) { return true; });
    AttachedNode node;
    node.body_a = attachment.body_a;
    node.node_a = node_a;
    node.body_b = attachment.body_b;
    node.nodes_b = walls_of_b.triangles().row(nearest.triangle).transpose();
    node.weights = nearest.point.weights;
    node.rest_offset = position - point_of_b(node, rest_b);
    node.compliance = attachment.compliance + added_compliance;
    result.push_back(node);
  }
  return result;
}

Eigen::Vector3d attachment_gap(const AttachedNode &node, const Points &positions_a, const Points &positions_b)
{
  return positions_a.row(node.node_a).transpose() - point_of_b(node, positions_b) - node.rest_offset;
}

void add_attachment_rows(const AttachedNode &node, const Points &positions_a, const Points &positions_b,
                         ConstraintRows &rows)
{
  const Eigen::Vector3d gap = attachment_gap(node, positions_a, positions_b);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    rows.add_row(RowKind::attachment, -gap[axis], node.compliance);
    rows.add_entry({node.body_a, node.node_a, unit});
    for (int i = 0; i < 3; ++i)
      if (node.weights[i] != 0)
        rows.add_entry({node.body_b, node.nodes_b[i], -node.weights[i] * unit});
  }
}
} // namespace pelvireg::registration
