// Area of the section of a closed surface by a plane.
#pragma once

#include "synthetic/dataset/geometry.h"

namespace pelvireg::metrics
{
/// mm^2, exact for the polyhedron; 0 where the plane misses it. Holes count negative. Caps are part of the closed
/// surface and take part, unlike in the judge's contours. points: n x 3, mm; triangles: m x 3, closed, normals outward.
/// Throws InputError as cut_surface does.
double section_area(const dataset::Points &points, const dataset::Triangles &triangles, const dataset::Plane &plane);
} // namespace pelvireg::metrics
