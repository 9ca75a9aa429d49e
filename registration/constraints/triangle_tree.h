// Bounding-volume tree over the triangles of a deforming surface.
#pragma once

#include "registration/constraints/closest_point.h"
#include "registration/registration.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace pelvireg::registration
{
struct NearestTriangle
{
  int triangle = -1; ///< row of the tree's triangles; -1: none
  TrianglePoint point;
};

/// Axis-aligned boxes, split at the median; the topology is built once, boxes are refitted as the surface moves.
class TriangleTree
{
public:
  TriangleTree() = default;
  /// Triangles index `positions`, which must be finite.
  TriangleTree(const Triangles &triangles, const Points &positions);

  const Triangles &triangles() const { return triangles_; }

  /// Adopt the current positions: boxes and vertex normals. Cost O(n).
  void refit(const Points &positions);

  /// Unit normal at a point of a triangle, interpolated from area-weighted vertex normals, so that it is continuous
  /// over the surface. Zero where the surface is degenerate.
  Eigen::Vector3d normal(int triangle, const Eigen::Vector3d &weights) const;

  /// Nearest triangle, within max_distance (mm), that `is_compatible` (given the triangle's row) accepts; of equally
  /// near ones that with the lowest row. `positions` must be those of the last refit().
  NearestTriangle nearest(const Eigen::Vector3d &point, double max_distance, const Points &positions,
                          const std::function<bool(int)> &is_compatible) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    int left = -1, right = -1; ///< children; -1 in a leaf; always behind their parent
    int first = 0, count = 0;  ///< leaf: range of order_
  };
  int build(int first, int count, const Points &centroids);
  void visit(int node, const Eigen::Vector3d &point, const Points &positions,
             const std::function<bool(int)> &is_compatible, NearestTriangle &best) const;

  Triangles triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  Points vertex_normals_; ///< not normalised, one a node of the body
};
} // namespace pelvireg::registration
