// Volume inside a closed triangulated surface.
#pragma once

#include "synthetic/dataset/geometry.h"

namespace pelvireg::metrics
{
/// Throws InputError, naming an edge, unless every edge is walked as often one way as the other: a closed, consistently
/// oriented surface. Indices must be in range.
void require_closed(const dataset::Triangles &triangles);

/// Volume by the divergence theorem, mm^3, exact to round-off for the closed polyhedron; negative when the normals
/// point inward. Where a surface runs through itself the overlap counts twice. Throws InputError for a position that is
/// not finite. Says nothing sensible of an open surface: require_closed() first.
double enclosed_volume(const dataset::Points &points, const dataset::Triangles &triangles);
} // namespace pelvireg::metrics
