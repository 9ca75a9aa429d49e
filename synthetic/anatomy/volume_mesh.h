// Tetrahedra inside a closed triangulated surface (gmsh), and inward extrusion of a surface into a wall.
#pragma once

#include "synthetic/anatomy/outer_surface.h"

namespace pelvireg::anatomy
{
/// Nodes (those of the surface first, in their order) and positive tetrahedra.
struct VolumeMesh
{
  dataset::Points points;
  dataset::Tets tets;
};

/// Fill a closed outward surface; `size` mm: aimed edge length inside. Deterministic. Throws ComputationError.
VolumeMesh fill_volume(const TriangleMesh &surface, double size);

/// One layer of prisms between the surface and the surface moved inward by `wall` along its normals, each prism cut
/// into three tetrahedra. Outer nodes first, then inner ones in the same order.
VolumeMesh extrude_wall(const TriangleMesh &surface, double wall);

/// Six times the signed volume of each tetrahedron is det[p1 - p0, p2 - p0, p3 - p0]: the least volume, mm^3.
double least_volume(const dataset::Points &points, const dataset::Tets &tets);
} // namespace pelvireg::anatomy
