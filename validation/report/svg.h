// Drawings put together from drawings. All begin with "<svg " and have a viewBox from 0 0.
#pragma once

#include <string>
#include <utility>

namespace pelvireg::report
{
/// A drawing at a place of the one that it becomes part of.
std::string placed(const std::string &svg, double x, double y, double width, double height);

/// Width and height of the viewBox; 0 without one.
std::pair<double, double> size_of(const std::string &svg);
} // namespace pelvireg::report
