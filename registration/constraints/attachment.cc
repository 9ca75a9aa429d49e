#include "registration/constraints/attachment.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pelvireg::registration
{
namespace
{
constexpr double least_area_ratio = 0.05; ///< of the rest area: a triangle squeezed further loses its normal
constexpr double least_shape = 0.01;      ///< twice the area over the longest edge squared; flatter ones carry nothing

struct Triangle
{
  Eigen::Vector3d corners[3];
  Eigen::Vector3d area_normal; ///< twice the area long

  Triangle(const Eigen::Vector3i &nodes, const Points &positions)
  {
    for (int i = 0; i < 3; ++i)
      corners[i] = positions.row(nodes[i]).transpose();
    area_normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  }

  /// The edge across from corner i, in the triangle's sense: a motion d of the corner changes area_normal by edge x d.
  Eigen::Vector3d edge(int i) const { return corners[(i + 2) % 3] - corners[(i + 1) % 3]; }

  bool is_flat() const
  {
    const double longest = std::max({edge(0).squaredNorm(), edge(1).squaredNorm(), edge(2).squaredNorm()});
    return area_normal.norm() <= least_shape * longest;
  }
};

/// Place the node over the triangle at rest.
void bind(AttachedNode &node, const Eigen::Vector3d &position, const TrianglePoint &nearest, const Triangle &rest)
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    point += nearest.weights[i] * rest.corners[i];
  const Eigen::Vector3d offset = position - point;
  const double area = rest.area_normal.norm();
  node.weights = nearest.weights;
  for (int i = 0; i < 3; ++i) // beyond an edge or a corner the offset has a part in the plane; edges sum to zero
    node.weights[i] += rest.area_normal.dot(rest.edge(i).cross(offset)) / (area * area);
  node.height = rest.area_normal.dot(offset) / area;
  node.least_area = least_area_ratio * area;
}

Eigen::Vector3d place_over(const AttachedNode &node, const Triangle &triangle)
{
  Eigen::Vector3d place = node.height / std::max(triangle.area_normal.norm(), node.least_area) * triangle.area_normal;
  for (int i = 0; i < 3; ++i)
    place += node.weights[i] * triangle.corners[i];
  return place;
}

/// d(height times normal) / d(area_normal), symmetric, 1/mm.
Eigen::Matrix3d offset_derivative(const AttachedNode &node, const Triangle &triangle)
{
  const double area = triangle.area_normal.norm();
  if (area < node.least_area)
    return node.height / node.least_area * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d normal = triangle.area_normal / area;
  return node.height / area * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
}
} // namespace

std::vector<AttachedNode> bind_attachment(const Attachment &attachment, const std::vector<Body> &bodies,
                                          const TriangleTree &walls_of_b, double added_compliance)
{
  const Points &rest_a = bodies[attachment.body_a].rest_positions;
  const Points &rest_b = bodies[attachment.body_b].rest_positions;
  const auto nodes_of = [&](int triangle) -> Eigen::Vector3i { return walls_of_b.triangles().row(triangle); };
  std::vector<AttachedNode> result;
  for (const int node_a : attachment.nodes_a)
  {
    const Eigen::Vector3d position = rest_a.row(node_a).transpose();
    const NearestTriangle nearest =
        walls_of_b.nearest(position, std::numeric_limits<double>::infinity(), rest_b,
                           [&](int triangle) { return !Triangle(nodes_of(triangle), rest_b).is_flat(); });
    if (nearest.triangle < 0)
      throw std::invalid_argument("attachment '" + attachment.name + "': no wall triangle of body '" +
                                  bodies[attachment.body_b].name +
                                  "' has an area, must be one at least; repair its outer surface");
    AttachedNode node;
    node.body_a = attachment.body_a;
    node.node_a = node_a;
    node.body_b = attachment.body_b;
    node.nodes_b = nodes_of(nearest.triangle);
    bind(node, position, nearest.point, Triangle(node.nodes_b, rest_b));
    node.compliance = attachment.compliance + added_compliance;
    result.push_back(node);
  }
  return result;
}

Eigen::Vector3d attachment_gap(const AttachedNode &node, const Points &positions_a, const Points &positions_b)
{
  return positions_a.row(node.node_a).transpose() - place_over(node, Triangle(node.nodes_b, positions_b));
}

void add_attachment_rows(const AttachedNode &node, const Points &positions_a, const Points &positions_b,
                         ConstraintRows &rows)
{
  const Eigen::Vector3d gap = attachment_gap(node, positions_a, positions_b);
  const Triangle triangle(node.nodes_b, positions_b);
  const Eigen::Matrix3d offset_change = offset_derivative(node, triangle);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    rows.add_row(RowKind::attachment, -gap[axis], node.compliance);
    rows.add_entry({node.body_a, node.node_a, unit});
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d jacobian = triangle.edge(i).cross(offset_change.col(axis)) - node.weights[i] * unit;
      if (!jacobian.isZero(0))
        rows.add_entry({node.body_b, node.nodes_b[i], jacobian});
    }
  }
}
} // namespace pelvireg::registration
