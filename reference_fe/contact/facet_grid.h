// Uniform grid over the facets of a surface: which facets may be near a point.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// Facets by the grid cells that their bounding boxes touch. Deterministic: candidates come in ascending order.
class FacetGrid
{
public:
  /// @param points 3 x n, mm. @param spacing edge of a grid cell, mm.
  FacetGrid(const Eigen::Matrix3Xd &points, const std::vector<std::array<int, 3>> &facets, double spacing);

  /// Facets whose bounding box may come within `distance` of `point`, ascending, each once.
  void candidates(const Eigen::Vector3d &point, double distance, std::vector<int> &facets) const;

private:
  std::int64_t key(int i, int j, int k) const { return (static_cast<std::int64_t>(i) * n_[1] + j) * n_[2] + k; }
  Eigen::Vector3i cell(const Eigen::Vector3d &point) const;

  double spacing_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i n_;
  std::vector<std::pair<std::int64_t, int>> entries_; ///< (cell, facet), sorted
};
} // namespace pelvireg::reference_fe
