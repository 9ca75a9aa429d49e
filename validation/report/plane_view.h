// The image plane as a page shows it: posterior to the right, superior up, as seen from the left.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <Eigen/Geometry>

namespace pelvireg::report
{
/// From space to the plane of the drawing, mm; y grows downwards as in SVG.
struct PlaneView
{
  Eigen::Vector3d origin, right, up;

  explicit PlaneView(const dataset::Plane &plane) : origin(plane.origin)
  {
    up = (Eigen::Vector3d::UnitZ() - plane.normal.z() * plane.normal).normalized();
    right = up.cross(plane.normal);
  }
  Eigen::Vector2d operator()(const Eigen::Vector3d &p) const { return {right.dot(p - origin), -up.dot(p - origin)}; }
};
} // namespace pelvireg::report
