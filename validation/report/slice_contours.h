// What the judge's slicer finds in the validation slices, as SVG paths.
#pragma once

#include "validation/report/nominal_surfaces.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// A name and where to write it, mm in the drawing.
struct SliceLabel
{
  std::string organ;
  double x = 0, y = 0;
};

/// One slice at the last step, in mm of PlaneView.
struct SliceContours
{
  int index = 0;                      ///< 0 is the DYN plane
  std::string truth;                  ///< path of all organs
  std::vector<std::string> estimates; ///< one a condition, in the order that was given
  std::vector<SliceLabel> labels;     ///< of the organs that the slice meets
};

struct SliceDrawing
{
  double left = 0, top = 0, width = 0, height = 0; ///< mm: holds the contours of all slices and conditions
  std::vector<SliceContours> slices;               ///< ascending
};

/// Cuts of the truth's and the conditions' last frames.
SliceDrawing slice_drawing(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                           const std::vector<ConditionSurfaces> &conditions);

/// All slices of one condition (its place in the drawing's list, its name for the reader) as small panels.
std::string slices_figure(const SliceDrawing &drawing, std::size_t condition, const std::string &name, double pitch);
} // namespace pelvireg::report
