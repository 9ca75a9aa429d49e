#include "registration/constraints/triangle_tree.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace pelvireg::registration
{
namespace
{
constexpr int leaf_size = 4;
}

TriangleTree::TriangleTree(const Triangles &triangles, const Points &positions) : triangles_(triangles)
{
  const int n_triangles = static_cast<int>(triangles.rows());
  Points centroids(n_triangles, 3);
  for (int t = 0; t < n_triangles; ++t)
    centroids.row(t) =
        (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
  order_.resize(n_triangles);
  std::iota(order_.begin(), order_.end(), 0);
  if (n_triangles == 0)
    return;
  build(0, n_triangles, centroids);
  refit(positions);
}

int TriangleTree::build(int first, int count, const Points &centroids)
{
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, -1, -1, first, count});
  if (count <= leaf_size)
    return index;
  Eigen::AlignedBox3d box;
  for (int k = first; k < first + count; ++k)
    box.extend(centroids.row(order_[k]).transpose());
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  std::sort(begin, begin + count,
            [&](int s, int t) { return std::tuple(centroids(s, axis), s) < std::tuple(centroids(t, axis), t); });
  const int left = build(first, count / 2, centroids);
  const int right = build(first + count / 2, count - count / 2, centroids);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

void TriangleTree::refit(const Points &positions)
{
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
  {
    node->box.setEmpty();
    if (node->left >= 0)
      node->box = nodes_[node->left].box.merged(nodes_[node->right].box);
    else
      for (int k = node->first; k < node->first + node->count; ++k)
        for (int corner = 0; corner < 3; ++corner)
          node->box.extend(positions.row(triangles_(order_[k], corner)).transpose());
  }
  vertex_normals_.setZero(positions.rows(), 3);
  for (Eigen::Index t = 0; t < triangles_.rows(); ++t)
  {
    const auto corner = [&](int i) -> Eigen::Vector3d { return positions.row(triangles_(t, i)).transpose(); };
    const Eigen::Vector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    for (int i = 0; i < 3; ++i)
      vertex_normals_.row(triangles_(t, i)) += area.transpose();
  }
}

Eigen::Vector3d TriangleTree::normal(int triangle, const Eigen::Vector3d &weights) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    sum += weights[i] * vertex_normals_.row(triangles_(triangle, i)).transpose().normalized();
  return sum.stableNormalized();
}

NearestTriangle TriangleTree::nearest(const Eigen::Vector3d &point, double max_distance, const Points &positions,
                                      const std::function<bool(int)> &is_compatible) const
{
  NearestTriangle best;
  best.point.squared_distance = max_distance * max_distance;
  if (!nodes_.empty())
    visit(0, point, positions, is_compatible, best);
  return best;
}

void TriangleTree::visit(int index, const Eigen::Vector3d &point, const Points &positions,
                         const std::function<bool(int)> &is_compatible, NearestTriangle &best) const
{
  const Node &node = nodes_[index];
  if (node.box.squaredExteriorDistance(point) > best.point.squared_distance)
    return;
  if (node.left >= 0)
  {
    const bool left_first =
        nodes_[node.left].box.squaredExteriorDistance(point) <= nodes_[node.right].box.squaredExteriorDistance(point);
    visit(left_first ? node.left : node.right, point, positions, is_compatible, best);
    visit(left_first ? node.right : node.left, point, positions, is_compatible, best);
    return;
  }
  for (int k = node.first; k < node.first + node.count; ++k)
  {
    const int t = order_[k];
    const auto corner = [&](int i) -> Eigen::Vector3d { return positions.row(triangles_(t, i)).transpose(); };
    const TrianglePoint candidate = closest_point(point, corner(0), corner(1), corner(2));
    const double distance = candidate.squared_distance;
    const bool nearer = distance < best.point.squared_distance ||
                        (distance == best.point.squared_distance && (best.triangle < 0 || t < best.triangle));
    if (nearer && is_compatible(t))
      best = {t, candidate};
  }
}
} // namespace pelvireg::registration
