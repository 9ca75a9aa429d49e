// Bounding-volume tree over the facets of a surface: which facets may be near a point.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace pelvireg::reference_fe
{
/// Axis-aligned boxes, halved at the median of the longest side. Deterministic: candidates come in ascending order.
class FacetTree
{
public:
  /// @param points 3 x n, mm.
  FacetTree(const Eigen::Matrix3Xd &points, const std::vector<std::array<int, 3>> &facets);

  /// Facets whose bounding box comes within `distance` (mm) of `point`, ascending.
  void candidates(const Eigen::Vector3d &point, double distance, std::vector<int> &facets) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    int left = -1, right = -1; ///< children; -1 in a leaf
    int first = 0, count = 0;  ///< leaf: range of order_
  };
  int build(int first, int count);

  std::vector<Eigen::AlignedBox3d> boxes_; ///< of every facet
  std::vector<int> order_;
  std::vector<Node> nodes_;
};
} // namespace pelvireg::reference_fe
