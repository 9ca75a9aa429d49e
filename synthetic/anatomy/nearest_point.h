// The generator's own closest point on a triangle.
#pragma once

#include <Eigen/Core>

namespace pelvireg::anatomy
{
/// Nearest point of the triangle a, b, c to p (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                                    const Eigen::Vector3d &c);
} // namespace pelvireg::anatomy
