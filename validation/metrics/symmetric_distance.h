// Both directions of the distance between two surfaces.
#pragma once

#include <vector>

namespace pelvireg::metrics
{
/// Of two surfaces, each sampled and measured to the other; mm.
struct SymmetricDistance
{
  double mean = 0; ///< over the samples of both together: average symmetric surface distance (ASSD)
  double hd95 = 0; ///< the larger of the two directed 95th percentiles: 95 % Hausdorff distance
};

/// Distances of the first surface's samples to the second, and of the second's to the first (mm). Percentiles as in
/// describe(). Throws InputError when either is empty or holds a value that is not finite.
SymmetricDistance symmetric_distance(const std::vector<double> &there, const std::vector<double> &back);
} // namespace pelvireg::metrics
