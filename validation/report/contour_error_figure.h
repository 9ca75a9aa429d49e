// Error of tracked outlines over the frames.
#pragma once

#include "validation/runner/outline_tracking.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// A panel an organ with mean distance over frames, a curve a tracker (at most six, in order of appearance), and a key:
/// one SVG document that stands alone or inside a page. Throws std::invalid_argument when there is no row.
std::string contour_error_figure(const std::vector<runner::ContourErrorRow> &rows);
} // namespace pelvireg::report
