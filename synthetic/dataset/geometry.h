// Shared geometric types of every file and interface. Types only: no algorithm of the judge, the reference
// or the registration may live here (DESIGN, section 1: types are shared, algorithms are not).
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// n x 3 coordinates or vectors, mm, LPS frame (+x left, +y posterior, +z superior).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m x 3 node indices, 0-based, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m x 4 node indices, 0-based, positive volume: det[p1-p0, p2-p0, p3-p0] > 0.
using Tets = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 4, Eigen::RowMajor>;
/// m x 8 node indices, 0-based, VTK_HEXAHEDRON order.
using Hexes = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 8, Eigen::RowMajor>;
/// m x 9 node indices, 0-based, VTK_BIQUADRATIC_QUAD order: corners 0-3 counter-clockwise seen from outside,
/// mid-sides of 01, 12, 23, 30, centre.
using Quads9 = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 9, Eigen::RowMajor>;
/// m x 10 node indices, 0-based, VTK_QUADRATIC_TETRA order: corners 0-3, mid-sides of 01, 12, 02, 03, 13, 23.
using Tets10 = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 10, Eigen::RowMajor>;
/// m x 6 node indices, 0-based, VTK_QUADRATIC_TRIANGLE order: corners 0-2, mid-sides of 01, 12, 20.
using Triangles6 = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 6, Eigen::RowMajor>;
/// n integers: region codes, node sets.
using Integers = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1>;

/// What a surface cell is. Stored as int32 beside every surface.
enum class SurfaceRegion : std::int32_t
{
  wall = 0,         ///< plain organ wall
  peritoneal = 1,   ///< organ wall that carries the abdominal pressure
  cervix_patch = 2, ///< the patch that vagina and uterus share
  cap = 3           ///< closes an anatomically open tube end: no control point, no sample, no metric
};

/// A plane in space. `normal` has unit length and points to the left (+x side).
struct Plane
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// A triangulated surface.
struct SurfaceMesh
{
  Points points;       ///< n x 3, mm
  Triangles triangles; ///< m x 3
  Integers region;     ///< m, SurfaceRegion codes
};

/// A closed polyline in a plane, counter-clockwise seen from the tip of the plane's normal for an outer boundary
/// (clockwise for a hole). Segment i joins point i and point i+1 (the last one joins the last point and point 0).
struct Contour
{
  Points points;          ///< k x 3, mm
  Points segment_normals; ///< k x 3, unit, in the plane, pointing out of the organ
  Integers segment_region; ///< k, SurfaceRegion code of the triangle that each segment was cut from
};

/// The four scored organs, in the order of every table.
inline const std::vector<std::string> organ_names = {"bladder", "vagina", "uterus", "rectum"};
} // namespace pelvireg::dataset
