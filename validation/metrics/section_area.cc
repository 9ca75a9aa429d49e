#include "validation/metrics/section_area.h"

#include "validation/metrics/plane_cut.h"

#include <Eigen/Geometry>

namespace pelvireg::metrics
{
double section_area(const dataset::Points &points, const dataset::Triangles &triangles, const dataset::Plane &plane)
{
  const dataset::Integers no_cap = dataset::Integers::Zero(triangles.rows());
  double area = 0;
  for (const CutSegment &segment : cut_surface(points, triangles, no_cap, plane))
  {
    const auto nodes = triangles.row(segment.triangle);
    const Eigen::Vector3d corner = points.row(nodes[0]);
    const Eigen::Vector3d outward =
        (points.row(nodes[1]).transpose() - corner).cross(points.row(nodes[2]).transpose() - corner);
    const Eigen::Vector3d a = segment.ends[0].position - plane.origin, b = segment.ends[1].position - plane.origin;
    // Counter-clockwise about the normal, the inside to the left.
    const double sign = (b - a).dot(plane.normal.cross(outward)) >= 0 ? 1 : -1;
    area += sign * plane.normal.dot(a.cross(b)) / 2;
  }
  return area;
}
} // namespace pelvireg::metrics
