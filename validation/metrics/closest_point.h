// Closest points of the two simplices that the judge measures against.
#pragma once

#include <Eigen/Core>

namespace pelvireg::metrics
{
/// The point of segment [a, b] closest to p; mm. A segment of length zero is the point a.
Eigen::Vector3d closest_point_on_segment(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b);

/// The point of triangle (a, b, c), its interior and border included, closest to p; mm. A triangle without area is
/// the union of its edges.
Eigen::Vector3d closest_point_on_triangle(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                                          const Eigen::Vector3d &c);
} // namespace pelvireg::metrics
