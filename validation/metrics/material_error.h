// What surface distance hides: how far material points are from where they really went.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/statistics.h"
#include "validation/metrics/surface_samples.h"

#include <vector>

namespace pelvireg::metrics
{
/// Error vectors e of n material points, boiled down; mm.
struct MaterialError
{
  Statistics distance;        ///< |e|
  double normal_mean = 0;     ///< of |e . n|
  double tangential_mean = 0; ///< of |e - (e . n) n|: a surface that slides along itself shows here alone
};

/// Unit normals of the samples' triangles, outward, when the nodes are at `points` (n x 3, mm). Throws InputError for a
/// triangle without area.
dataset::Points sample_normals(const std::vector<SurfaceSample> &samples, const dataset::Triangles &triangles,
                               const dataset::Points &points);

/// Error vectors (k x 3, mm) against the truth's unit normals at the same points (k x 3). Throws InputError for other
/// shapes, no rows, or a value that is not finite.
MaterialError material_error(const dataset::Points &errors, const dataset::Points &normals);
} // namespace pelvireg::metrics
