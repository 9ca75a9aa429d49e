#include "validation/metrics/material_points.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/surface_distance.h"

#include <Eigen/Geometry>

namespace pelvireg::metrics
{
namespace
{
/// Weights of the corners at a point of the triangle's plane, by areas.
Eigen::Vector3d barycentric(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                            const Eigen::Vector3d &c)
{
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double whole = normal.squaredNorm();
  const double of_b = normal.dot((p - a).cross(c - a)) / whole, of_c = normal.dot((b - a).cross(p - a)) / whole;
  return {1 - of_b - of_c, of_b, of_c};
}
} // namespace

std::vector<SurfaceSample> closest_samples(const dataset::SurfaceMesh &rest, const dataset::Points &points)
{
  const SurfaceTree tree(rest.points, rest.triangles, rest.region);
  if (!points.allFinite())
    throw InputError("material points: a point is not finite; the surface they come from is broken");
  std::vector<SurfaceSample> samples;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    const ClosestPoint closest = tree.closest(points.row(i));
    const auto nodes = rest.triangles.row(closest.triangle);
    samples.push_back({closest.triangle, barycentric(closest.position, rest.points.row(nodes[0]),
                                                     rest.points.row(nodes[1]), rest.points.row(nodes[2]))});
  }
  return samples;
}
} // namespace pelvireg::metrics
