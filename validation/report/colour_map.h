// The colours of errors and organs.
#pragma once

#include <array>
#include <map>
#include <string>

namespace pelvireg::report
{
using Colour = std::array<double, 3>; ///< red, green, blue, 0 … 1 (sRGB)

/// Viridis at even steps from 0 to 1: even in lightness, readable in grey and for the colour-blind.
inline constexpr std::array<Colour, 6> viridis = {{{0.267, 0.005, 0.329},
                                                   {0.254, 0.265, 0.530},
                                                   {0.164, 0.471, 0.558},
                                                   {0.135, 0.659, 0.518},
                                                   {0.478, 0.821, 0.318},
                                                   {0.993, 0.906, 0.144}}};

inline constexpr double error_scale =
    4; ///< mm, the paper's bound: the same in every report, so that pictures can be compared

inline const std::map<std::string, Colour> organ_colours = {{"bladder", {0.95, 0.80, 0.25}},
                                                            {"vagina", {0.95, 0.55, 0.65}},
                                                            {"uterus", {0.68, 0.36, 0.58}},
                                                            {"rectum", {0.60, 0.40, 0.26}}};
inline constexpr Colour floor_colour = {0.62, 0.62, 0.62};

/// Between the anchors linear; the ends beyond 0 and 1.
Colour viridis_at(double share);
} // namespace pelvireg::report
