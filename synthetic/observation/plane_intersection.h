// Exact intersection of a closed triangulated surface with a plane.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <string>
#include <vector>

namespace pelvireg::observation
{
/// One loop of the intersection.
struct PlaneLoop
{
  dataset::Contour contour;
  /// k: index of the surface triangle that segment i was cut from.
  std::vector<std::int32_t> triangle;
  double area = 0;   ///< mm^2, signed: > 0 for an outer boundary, < 0 for a hole
  double length = 0; ///< mm
};

/// Points closer together than this are one point of the outline, mm.
inline constexpr double merge_distance = 1e-9;

/// The loops of the intersection, outer boundaries counter-clockwise seen from the tip of `plane.normal`, holes
/// clockwise; sorted by decreasing |area|.
///
/// A vertex whose signed distance is exactly 0 counts as lying on the positive side (symbolic perturbation). Hence
/// every crossed edge has one end on each side, every crossed triangle gives one segment, and the loops close, whatever
/// lies in the plane:
///   - a vertex or an edge that touches the plane from the positive side gives nothing, and from the negative side a
///     loop without extent, which is dropped;
///   - a flat part in the plane with the body on the negative side gives its border; with the body on the positive side
///     nothing: the result is the limit of the plane moved by +0 towards its negative side.
/// Segments shorter than `merge_distance` are merged into the point at which they start; a loop with fewer than three
/// points left, or without area (|area| <= merge_distance * length), is dropped. Each loop starts at its crossed edge
/// with the lowest vertex indices, so that it does not depend on the order of the triangles.
///
/// @param surface closed, manifold, outward oriented; `region` may be empty (then every segment is wall).
/// @param name    named in the error.
/// Throws InputError when the surface is not closed or not manifold where the plane cuts it.
std::vector<PlaneLoop> intersect(const dataset::SurfaceMesh &surface, const dataset::Plane &plane,
                                 const std::string &name);
} // namespace pelvireg::observation
