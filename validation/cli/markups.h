// Closed curves of 3D Slicer: .mrk.json, markups schema 1.0.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// One closed curve.
struct ClosedCurve
{
  std::string organ;      ///< the curve's name; when it has none, the first word of its first label or of the file
  dataset::Points points; ///< k x 3, mm, LPS: the control points
};

/// Every closed curve of a file, in LPS whatever the file is in. Throws InputError when the file is no markups file,
/// has no closed curve, another length unit than mm, a curve with fewer than three points or a value that is not
/// finite, an organ that is none of ours, or one twice.
std::vector<ClosedCurve> read_curves(const std::filesystem::path &file);

/// The file's text, in LPS.
std::string curves_text(const std::vector<ClosedCurve> &curves);
} // namespace pelvireg::cli
