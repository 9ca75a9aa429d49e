#include "validation/metrics/closest_point.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace pelvireg::metrics
{
namespace
{
/// Does the foot of p on the plane of (a, b, c) lie in the triangle? `normal` is not zero.
bool projects_inside(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                     const Eigen::Vector3d &c, const Eigen::Vector3d &normal)
{
  return normal.dot((b - a).cross(p - a)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
         normal.dot((a - c).cross(p - c)) >= 0;
}
} // namespace

Eigen::Vector3d closest_point_on_segment(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b)
{
  const Eigen::Vector3d direction = b - a;
  const double squared_length = direction.squaredNorm();
  if (!(squared_length > 0))
    return a;
  const double parameter = std::clamp(direction.dot(p - a) / squared_length, 0.0, 1.0);
  return a + parameter * direction;
}

Eigen::Vector3d closest_point_on_triangle(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                                          const Eigen::Vector3d &c)
{
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double squared_norm = normal.squaredNorm();
  if (squared_norm > 0 && projects_inside(p, a, b, c, normal))
    return p - normal.dot(p - a) / squared_norm * normal;

  Eigen::Vector3d best = closest_point_on_segment(p, a, b);
  for (const Eigen::Vector3d &candidate : {closest_point_on_segment(p, b, c), closest_point_on_segment(p, c, a)})
    if ((candidate - p).squaredNorm() < (best - p).squaredNorm())
      best = candidate;
  return best;
}
} // namespace pelvireg::metrics
