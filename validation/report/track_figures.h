// Frames of an image series with outlines drawn over them.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "synthetic/dataset/image_series.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// A closed outline over one frame; mm, LPS.
struct OverlayOutline
{
  std::string organ; ///< of dataset::organ_names: decides the colour
  dataset::Points points;
  bool is_dashed = false; ///< the truth
};

/// One frame of the figure.
struct OverlayFrame
{
  int frame = 0; ///< 0-based
  std::vector<OverlayOutline> outlines;
};

/// A row of frames, three times enlarged, cut to what the outlines need and a margin of 15 mm, as a PNG file; tracked
/// outlines solid in their organ's colour, true ones dashed in white. Throws std::runtime_error when the file cannot be
/// written, InputError for a frame that the series does not have.
void write_overlay(const dataset::ImageSeries &series, const std::vector<OverlayFrame> &frames,
                   const std::filesystem::path &file);
} // namespace pelvireg::report
