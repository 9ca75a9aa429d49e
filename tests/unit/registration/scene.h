// Made-up bodies for the tests of the registration.
#pragma once

#include "registration/registration.h"

#include <Eigen/Geometry>

namespace pelvireg::registration::scene
{
/// Closed ellipsoid of the given outer half-axes (mm), hollow: one layer of tetrahedra, `wall` mm thick, extruded
/// inward from an icosphere subdivided `n_subdivisions` times.
Body hollow_ellipsoid(const Eigen::Vector3d &half_axes, double wall, int n_subdivisions,
                      const Eigen::Vector3d &centre = Eigen::Vector3d::Zero());

/// Box [0, size] + origin of n hexahedra along each axis; every hexahedron is split into six tetrahedra when wanted.
/// Outer triangles are set (all wall) when `with_surface`.
Body block(const Eigen::Vector3d &size, const Eigen::Vector3i &n, bool tetrahedral, bool with_surface = false,
           const Eigen::Vector3d &origin = Eigen::Vector3d::Zero());

/// Control points where the plane cuts the outer triangles of a body at `positions`: every `stride`-th segment's
/// middle, with the triangle's normal projected into the plane.
OutlineObservation outline(const Body &body, int index, const Points &positions, const Eigen::Vector3d &plane_origin,
                           const Eigen::Vector3d &plane_normal, int stride = 1);
} // namespace pelvireg::registration::scene
