#include "validation/metrics/material_points.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/closest_point.h"
#include "validation/metrics/surface_distance.h"

#include <Eigen/Geometry>

#include <limits>

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
  require_usable_surface(rest.points, rest.triangles, rest.region);
  if (!points.allFinite())
    throw InputError("material points: a point is not finite; the surface they come from is broken");
  std::vector<SurfaceSample> samples;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    const Eigen::Vector3d p = points.row(i);
    double best = std::numeric_limits<double>::infinity();
    SurfaceSample closest;
    for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t)
    {
      if (!is_scored(rest.region[t]))
        continue;
      const Eigen::Vector3d a = rest.points.row(rest.triangles(t, 0)), b = rest.points.row(rest.triangles(t, 1)),
                            c = rest.points.row(rest.triangles(t, 2));
      const Eigen::Vector3d foot = closest_point_on_triangle(p, a, b, c);
      if (const double distance = (foot - p).squaredNorm(); distance < best)
      {
        best = distance;
        closest = {static_cast<int>(t), barycentric(foot, a, b, c)};
      }
    }
    if (!(best < std::numeric_limits<double>::infinity()))
      throw InputError("material points: the surface has no scored triangle to look on; check its regions");
    samples.push_back(closest);
  }
  return samples;
}
} // namespace pelvireg::metrics
