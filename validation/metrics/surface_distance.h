// Distance from points to the closest triangle of a surface.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <vector>

namespace pelvireg::metrics
{
/// Does a triangle of this SurfaceRegion code carry samples and count as a target? All but caps do (DESIGN 4).
bool is_scored(std::int32_t region);

/// Throws InputError unless there are triangles, one region code each, indices in range and finite positions.
void require_usable_surface(const dataset::Points &points, const dataset::Triangles &triangles,
                            const dataset::Integers &region);

/// The point of a surface closest to another.
struct ClosestPoint
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< mm
  double distance = 0;                                ///< mm
  int triangle = -1;                                  ///< row of the triangles that the tree was made of, 0-based
};

/// The scored triangles of a surface in a tree of bounding boxes: exact closest-point queries.
class SurfaceTree
{
public:
  /// points: n x 3, mm; triangles: m x 3, 0-based; region: m. Caps are left out: a sample beyond the open end of a
  /// tube is measured to the rim, not to a lid that no anatomy has. Throws InputError as require_usable_surface does,
  /// and when only caps are there.
  SurfaceTree(const dataset::Points &points, const dataset::Triangles &triangles, const dataset::Integers &region);

  /// The closest point, exact to round-off. Of two triangles as close the one that comes first in the tree, whose order
  /// depends on the surface alone.
  ClosestPoint closest(const Eigen::Vector3d &p) const;

  /// Distance of p to the closest triangle, mm.
  double distance(const Eigen::Vector3d &p) const { return closest(p).distance; }

private:
  struct Node
  {
    Eigen::Vector3d lower, upper;
    int first = 0, n = 0; ///< corners_ of a leaf; n = 0: children are first and first + 1
  };

  void split(int node, std::vector<int> &order, int begin, int end);

  std::vector<Eigen::Matrix3d> corners_; ///< one corner a row, in leaf order
  std::vector<int> rows_;                ///< row of each of them in the surface's triangles
  std::vector<Eigen::Matrix3d> unsorted_corners_;
  std::vector<int> unsorted_rows_;
  std::vector<Node> nodes_;
};

/// Distance of each of k samples (k x 3, mm) to the closest scored triangle. One-sided: it says nothing of parts of the
/// surface that no sample is near. Throws InputError for no samples, positions that are not finite, a broken surface.
std::vector<double> surface_distances(const dataset::Points &samples, const SurfaceTree &surface);
std::vector<double> surface_distances(const dataset::Points &samples, const dataset::Points &points,
                                      const dataset::Triangles &triangles, const dataset::Integers &region);
} // namespace pelvireg::metrics
