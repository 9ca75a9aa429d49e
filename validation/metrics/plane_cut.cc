#include "validation/metrics/plane_cut.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/surface_distance.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pelvireg::metrics
{
namespace
{
/// Both triangles of an edge get the same bits: the edge is always walked from its smaller node.
EdgeCut cut_edge(int a, int b, const dataset::Points &points, const Eigen::VectorXd &height)
{
  if (a > b)
    std::swap(a, b);
  EdgeCut cut;
  cut.node_a = a;
  cut.node_b = b;
  cut.weight_b = height[a] / (height[a] - height[b]);
  cut.position = cut.interpolate(points);
  return cut;
}

void require_unit_normal(const dataset::Plane &plane)
{
  const double length = plane.normal.norm();
  if (!(std::abs(length - 1) <= 1e-9) || !plane.origin.allFinite())
    throw InputError(fmt::format("plane: origin ({}, {}, {}) and normal of length {}, must be finite and 1 +/- 1e-9",
                                 plane.origin.x(), plane.origin.y(), plane.origin.z(), length));
}
} // namespace

Eigen::Vector3d EdgeCut::interpolate(const dataset::Points &field) const
{
  return ((1 - weight_b) * field.row(node_a) + weight_b * field.row(node_b)).transpose();
}

std::vector<CutSegment> cut_surface(const dataset::Points &points, const dataset::Triangles &triangles,
                                    const dataset::Integers &region, const dataset::Plane &plane)
{
  require_usable_surface(points, triangles, region);
  require_unit_normal(plane);
  const Eigen::VectorXd height = (points.rowwise() - plane.origin.transpose()) * plane.normal;

  std::vector<CutSegment> segments;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    if (!is_scored(region[t]))
      continue;
    CutSegment segment;
    std::size_t n_ends = 0;
    for (int k = 0; k < 3; ++k)
    {
      const int a = triangles(t, k);
      const int b = triangles(t, (k + 1) % 3);
      if ((height[a] >= 0) != (height[b] >= 0))
        segment.ends[n_ends++] = cut_edge(a, b, points, height);
    }
    segment.triangle = static_cast<int>(t);
    if (n_ends == 2 && segment.length() > 0)
      segments.push_back(segment);
  }
  return segments;
}

dataset::Plane slice_plane(const dataset::Plane &dyn_plane, int k, double pitch)
{
  return {dyn_plane.origin + k * pitch * dyn_plane.normal, dyn_plane.normal};
}
} // namespace pelvireg::metrics
