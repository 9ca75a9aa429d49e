// Surfaces of a generated anatomy and distances between them, for the tests: brute force on purpose.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <map>
#include <string>

namespace pelvireg::test
{
/// Outer surface of a shell (zeta = +1, each quadratic cell as 8 triangles, open ends open) or of a solid (4 a face).
dataset::SurfaceMesh outer_surface(const dataset::ReferenceShell &shell, double side = 0.5);
dataset::SurfaceMesh outer_surface(const dataset::ReferenceSolid &solid);
/// Both faces and the rim faces of the pelvic floor: everything that another organ may run into.
dataset::SurfaceMesh floor_surfaces(const dataset::ReferenceShell &floor);
/// True outer surfaces of the four organs and of the floor.
std::map<std::string, dataset::SurfaceMesh> reference_surfaces(const dataset::ReferenceModel &model);
std::map<std::string, dataset::SurfaceMesh> registration_surfaces(const dataset::RegistrationModel &model);

struct Gap
{
  double distance = 0; ///< mm; 0 when the surfaces cross
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

/// Least distance between two triangulated surfaces, crossing included. Triangles of region cervix_patch, and pairs
/// of triangles near the patch's rim (both with a point within `rim_margin` of a patch triangle), are left out.
Gap gap_between(const dataset::SurfaceMesh &a, const dataset::SurfaceMesh &b, double rim_margin = 0);

/// Distance of a point to a triangulated surface, all regions.
double distance_to(const Eigen::Vector3d &point, const dataset::SurfaceMesh &surface);
/// Does the segment from a to b cross the surface?
bool segment_meets(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const dataset::SurfaceMesh &surface);

/// Volume enclosed by a closed outward surface, mm^3.
double enclosed_volume(const dataset::SurfaceMesh &surface);
} // namespace pelvireg::test
