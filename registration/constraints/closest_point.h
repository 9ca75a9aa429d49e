// Closest point of a triangle.
#pragma once

#include <Eigen/Core>

namespace pelvireg::registration
{
struct TrianglePoint
{
  Eigen::Vector3d weights = Eigen::Vector3d::Zero(); ///< barycentric, in [0, 1], sum 1
  double squared_distance = 0;                       ///< mm^2
};

/// Closest point of triangle (a, b, c) to p, by Voronoi regions (Ericson, Real-Time Collision Detection, 2004, 5.1.5).
TrianglePoint closest_point(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                            const Eigen::Vector3d &c);
} // namespace pelvireg::registration
