// The judge's own slicer. It shares nothing with synthetic/observation, whose contours drive the registration: here
// each triangle is clipped by a half-space on its own and the cut is an unordered set of segments; neighbours in the
// mesh are never looked at.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <array>
#include <vector>

namespace pelvireg::metrics
{
/// Where a mesh edge meets the plane: (1 - weight_b) node_a + weight_b node_b, with node_a < node_b.
struct EdgeCut
{
  int node_a = 0, node_b = 0;                         ///< 0-based
  double weight_b = 0;                                ///< 0 … 1
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< mm

  /// The value of a field (n x 3, one row a node) at this point.
  Eigen::Vector3d interpolate(const dataset::Points &field) const;
};

/// The part of one triangle that lies in the plane.
struct CutSegment
{
  std::array<EdgeCut, 2> ends;
  int triangle = 0; ///< 0-based

  double length() const { return (ends[1].position - ends[0].position).norm(); } ///< mm
};

/// Cut the scored triangles (caps excluded) with a plane. A node in the plane counts as lying on the side of the
/// normal, so a plane through a node, an edge or a facet gives each piece once and a plane that only touches gives
/// nothing or segments of length zero, which are left out. Empty when the plane misses the surface.
/// Throws InputError for a broken surface (see require_usable_surface) or a plane whose normal is not of unit length.
std::vector<CutSegment> cut_surface(const dataset::Points &points, const dataset::Triangles &triangles,
                                    const dataset::Integers &region, const dataset::Plane &plane);

/// The plane k * pitch mm from `dyn_plane` along its normal, fixed in space (DESIGN 4).
dataset::Plane slice_plane(const dataset::Plane &dyn_plane, int k, double pitch);
} // namespace pelvireg::metrics
