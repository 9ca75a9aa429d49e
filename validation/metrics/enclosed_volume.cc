#include "validation/metrics/enclosed_volume.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pelvireg::metrics
{
void require_closed(const dataset::Triangles &triangles)
{
  // Smaller node, larger node, +1 when walked from the smaller one.
  std::vector<std::array<std::int32_t, 3>> edges;
  edges.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();)
  {
    const auto [a, b, direction] = edges[i];
    int sum = 0;
    for (; i < edges.size() && edges[i][0] == a && edges[i][1] == b; ++i)
      sum += edges[i][2];
    if (sum != 0)
      throw InputError(fmt::format("surface: it is open or badly oriented at the edge of nodes {} and {}, a closed "
                                   "surface is needed; close it with caps",
                                   a, b));
  }
}

double enclosed_volume(const dataset::Points &points, const dataset::Triangles &triangles)
{
  if (points.rows() == 0 || !points.allFinite())
    throw InputError("volume: a position is not finite, or there is none; the positions it comes from are broken");
  const Eigen::Vector3d origin = points.colwise().mean().transpose(); // near the surface: less cancellation
  double volume = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    const Eigen::Vector3d a = points.row(triangles(t, 0)).transpose() - origin,
                          b = points.row(triangles(t, 1)).transpose() - origin,
                          c = points.row(triangles(t, 2)).transpose() - origin;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}
} // namespace pelvireg::metrics
