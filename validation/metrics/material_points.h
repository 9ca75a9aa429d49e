// Where one material point lies on another mesh of the same surface.
#pragma once

#include "validation/metrics/surface_samples.h"

namespace pelvireg::metrics
{
/// The closest points of a rest surface's scored triangles (caps are left out) to each of k points (k x 3, mm): a field
/// on the surface's nodes is taken there with sample_positions(). Throws InputError as SurfaceTree does.
std::vector<SurfaceSample> closest_samples(const dataset::SurfaceMesh &rest, const dataset::Points &points);
} // namespace pelvireg::metrics
