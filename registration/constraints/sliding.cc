#include "registration/constraints/sliding.h"

#include <Eigen/Dense>

#include <functional>

namespace pelvireg::registration
{
namespace
{
/// Sine of the least angle between a triangle and the image plane at which its normal still has a direction in it (3°).
constexpr double least_in_plane_part = 0.05;

Eigen::Vector3d corner(const TriangleTree &tree, const Points &positions, int triangle, int i)
{
  return positions.row(tree.triangles()(triangle, i)).transpose();
}

Eigen::Vector3d triangle_normal(const TriangleTree &tree, const Points &positions, int triangle)
{
  const Eigen::Vector3d a = corner(tree, positions, triangle, 0);
  return (corner(tree, positions, triangle, 1) - a).cross(corner(tree, positions, triangle, 2) - a);
}

/// Unit; zero when the surface normal is zero or almost that of the plane.
Eigen::Vector3d in_plane_direction(const Eigen::Vector3d &surface_normal, const Eigen::Vector3d &plane_normal)
{
  const Eigen::Vector3d projected = surface_normal - surface_normal.dot(plane_normal) * plane_normal;
  const double length = projected.norm();
  if (!(length > least_in_plane_part * surface_normal.norm()))
    return Eigen::Vector3d::Zero();
  // Projected twice: the first pass leaves round-off of the order of the part it removed.
  const Eigen::Vector3d unit = projected / length;
  return (unit - unit.dot(plane_normal) * plane_normal).normalized();
}
} // namespace

SlidingMatch match_control_point(const TriangleTree &tree, const Points &positions, const Eigen::Vector3d &point,
                                 const Eigen::Vector3d &contour_normal, const Eigen::Vector3d &plane_normal,
                                 const Options &options)
{
  const Eigen::Vector3d wanted = (contour_normal - contour_normal.dot(plane_normal) * plane_normal).normalized();
  const auto agrees = [&](int triangle)
  {
    const Eigen::Vector3d direction = in_plane_direction(triangle_normal(tree, positions, triangle), plane_normal);
    return !direction.isZero(0) && direction.dot(wanted) >= options.min_normal_agreement;
  };
  const NearestTriangle nearest = tree.nearest(point, options.max_match_distance, positions,
                                               std::cref(agrees)); // by reference: std::function would copy to the heap
  SlidingMatch match;
  if (nearest.triangle < 0)
    return match;
  match.is_accepted = true;
  match.nodes = tree.triangles().row(nearest.triangle).transpose();
  match.weights = nearest.point.weights;
  // The normal at q_s varies continuously; the triangle's own would make a point near a ridge flip between two
  // directions from step to step, and never settle.
  match.direction = in_plane_direction(tree.normal(nearest.triangle, match.weights), plane_normal);
  if (match.direction.isZero(0))
    match.direction = in_plane_direction(triangle_normal(tree, positions, nearest.triangle), plane_normal);
  if (options.mutation.unprojected_normals)
    match.direction = tree.normal(nearest.triangle, match.weights).normalized();
  Eigen::Vector3d on_surface = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    on_surface += match.weights[i] * corner(tree, positions, nearest.triangle, i);
  match.gap = match.direction.dot(point - on_surface);
  return match;
}

void add_sliding_row(const SlidingMatch &match, int body, double compliance, ConstraintRows &rows)
{
  rows.add_row(RowKind::sliding, match.gap, compliance);
  for (int i = 0; i < 3; ++i)
    if (match.weights[i] != 0)
      rows.add_entry({body, match.nodes[i], match.weights[i] * match.direction});
}
} // namespace pelvireg::registration
