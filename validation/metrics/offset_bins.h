// A quantity by the distance from the image plane.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/statistics.h"

#include <vector>

namespace pelvireg::metrics
{
/// Samples whose offset lies in one slab parallel to the plane.
struct OffsetBin
{
  int index = 0;     ///< slab [(index - 1/2) width, (index + 1/2) width), positive along the normal
  Statistics values; ///< in the unit of the values
};

/// Signed distance of each of n points (n x 3, mm) from the plane, mm; positive along its normal.
std::vector<double> plane_offsets(const dataset::Points &points, const dataset::Plane &plane);

/// values[i] belongs to offsets[i]; bins in order of their index, those without a sample absent. Every sample counts
/// once, in whatever direction its surface runs: unlike in a slice, no part of a surface weighs more because the plane
/// meets it at a small angle. Throws InputError for other lengths, a width that is not positive, a value that is not
/// finite, no values.
std::vector<OffsetBin> bin_by_offset(const std::vector<double> &offsets, const std::vector<double> &values,
                                     double width);
} // namespace pelvireg::metrics
