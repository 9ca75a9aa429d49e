#include "validation/metrics/offset_bins.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <map>

namespace pelvireg::metrics
{
std::vector<double> plane_offsets(const dataset::Points &points, const dataset::Plane &plane)
{
  std::vector<double> offsets;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    offsets.push_back((points.row(i).transpose() - plane.origin).dot(plane.normal));
  return offsets;
}

std::vector<OffsetBin> bin_by_offset(const std::vector<double> &offsets, const std::vector<double> &values,
                                     double width)
{
  if (!(width > 0) || !std::isfinite(width) || offsets.size() != values.size() || values.empty())
    throw InputError(fmt::format("error by distance: {} offsets, {} values, bins of {} mm; must be as many, at least "
                                 "one, and a positive number",
                                 offsets.size(), values.size(), width));
  std::map<int, std::vector<double>> bins;
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    const double place = std::floor(offsets[i] / width + 0.5);
    if (!(std::abs(place) < 1e6))
      throw InputError(
          fmt::format("error by distance: offset {} is {} mm, beyond any body; the positions it comes from "
                      "are broken",
                      i, offsets[i]));
    bins[static_cast<int>(place)].push_back(values[i]);
  }
  std::vector<OffsetBin> result;
  for (const auto &[index, members] : bins)
    result.push_back({index, describe(members)});
  return result;
}
} // namespace pelvireg::metrics
