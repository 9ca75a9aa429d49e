// Do organs of a case overlap or touch?
#pragma once

#include "synthetic/anatomy/parameters.h"

namespace pelvireg::anatomy
{
/// Least allowed gap between the true outer surfaces of two organs, the floor included, outside the shared patch, mm.
inline constexpr double least_gap = 0.5;

/// Throws InputError that names the two organs, the place and the gap when two of them come closer than `least_gap`.
void check_separation(const Parameters &parameters);
} // namespace pelvireg::anatomy
