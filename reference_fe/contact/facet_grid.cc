#include "reference_fe/contact/facet_grid.h"

#include <algorithm>

namespace pelvireg::reference_fe
{
FacetGrid::FacetGrid(const Eigen::Matrix3Xd &points, const std::vector<std::array<int, 3>> &facets, double spacing)
    : spacing_(spacing), origin_(points.rowwise().minCoeff())
{
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - origin_;
  n_ = (extent / spacing_).array().floor().cast<int>() + 1;
  for (std::size_t f = 0; f < facets.size(); ++f)
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = points.col(facets[f][k]);
    const Eigen::Vector3i low = cell(corners.rowwise().minCoeff()), high = cell(corners.rowwise().maxCoeff());
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k)
          entries_.emplace_back(key(i, j, k), static_cast<int>(f));
  }
  std::sort(entries_.begin(), entries_.end());
}

Eigen::Vector3i FacetGrid::cell(const Eigen::Vector3d &point) const
{
  const Eigen::Array3d at = ((point - origin_) / spacing_).array().floor();
  return at.max(0.).min((n_ - Eigen::Vector3i::Ones()).cast<double>().array()).cast<int>();
}

void FacetGrid::candidates(const Eigen::Vector3d &point, double distance, std::vector<int> &facets) const
{
  facets.clear();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(distance);
  const Eigen::Vector3d end = origin_ + spacing_ * n_.cast<double>();
  if (((point + reach).array() < origin_.array()).any() || ((point - reach).array() > end.array()).any())
    return;
  const Eigen::Vector3i low = cell(point - reach), high = cell(point + reach);
  for (int i = low[0]; i <= high[0]; ++i)
    for (int j = low[1]; j <= high[1]; ++j)
    {
      // Cells along k are neighbours in the sorted list.
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), std::pair(key(i, j, low[2]), 0));
      for (; entry != entries_.end() && entry->first <= key(i, j, high[2]); ++entry)
        facets.push_back(entry->second);
    }
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
}
} // namespace pelvireg::reference_fe
