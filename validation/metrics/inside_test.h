// Is a point inside a closed surface? Many questions to one surface.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <vector>

namespace pelvireg::metrics
{
/// Counts how often a closed surface winds around a point, along the half line from the point upward (+z). The
/// triangles are listed by cells of a grid in (x, y), so that a question asks only those above and below the point.
/// Every comparison is half-open, so edges and nodes that the half line meets count once, without any tolerance; caps
/// count as triangles.
class InsideTest
{
public:
  /// points: n x 3, mm; triangles: m x 3, 0-based, closed, normals outward. Throws InputError for no triangles, an
  /// index out of range or a position that is not finite.
  InsideTest(const dataset::Points &points, const dataset::Triangles &triangles);

  /// Does the surface wind around p at least once? A point on the surface is on either side.
  bool is_inside(const Eigen::Vector3d &p) const;

private:
  int cell_of(double x, double y) const;
  int winding(const Eigen::Vector3d &p, const Eigen::Vector3i &nodes) const;

  dataset::Points points_;
  std::vector<Eigen::Vector3i> triangles_; ///< by cell; a triangle is listed in every cell that its box meets
  std::vector<int> first_;                 ///< cell c lists triangles_[first_[c]] … triangles_[first_[c + 1] - 1]
  Eigen::Vector2d lower_, upper_;
  Eigen::Vector2d cell_size_;
  int n_columns_ = 1, n_rows_ = 1;
};
} // namespace pelvireg::metrics
