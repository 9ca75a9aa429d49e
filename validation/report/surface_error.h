// The error of a registered surface, point by point, as the exported files show it.
#pragma once

#include "synthetic/dataset/truth.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// The truth's displacement at an increment; 0 is the rest shape. n x 3, mm.
dataset::Points displacement_of(const dataset::TruthSurface &surface, std::size_t increment);

/// Distance of each point (n x 3, mm) to the truth's surface of the organ at that increment, mm; empty for an organ or
/// an increment that the truth does not have.
std::vector<double> distances_to_truth(const dataset::Truth &truth, const std::string &organ, std::size_t increment,
                                       const dataset::Points &points);
} // namespace pelvireg::report
