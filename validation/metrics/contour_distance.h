// Distance between two cuts in one plane: the error by slice.
#pragma once

#include "validation/metrics/plane_cut.h"

#include <vector>

namespace pelvireg::metrics
{
/// Total length, mm.
double contour_length(const std::vector<CutSegment> &segments);

/// Even samples by arc length: n = ceil(length / spacing) points, each in the middle of its share of the total length,
/// which is counted through the segments in their order. n x 3, mm; no rows for an empty cut.
/// Throws InputError for a spacing that is not positive.
dataset::Points sample_contour(const std::vector<CutSegment> &segments, double spacing);

/// Distance of each sample of the truth's cut (every `spacing` mm of arc length) to the closest segment of the
/// estimate's cut in the same plane, mm. One-sided, like the surface error. Throws InputError when either cut is
/// empty: the caller decides what a missed slice means.
std::vector<double> contour_distances(const std::vector<CutSegment> &truth, const std::vector<CutSegment> &estimate,
                                      double spacing);
} // namespace pelvireg::metrics
