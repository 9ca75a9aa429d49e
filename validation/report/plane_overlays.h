// Contours in the DYN plane at the last step, from the judge's own slicer.
#pragma once

#include "validation/report/nominal_surfaces.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// A drawing of one condition.
struct NamedSvg
{
  std::string condition;
  std::string svg;
};

/// Rest, truth and estimate, one panel a registered condition, in reading order and on one scale.
std::vector<NamedSvg> plane_overlays(const ReportInputs &inputs, const std::vector<MovingSurface> &truth_surfaces,
                                     const std::vector<ConditionSurfaces> &conditions);

/// What the lines mean.
std::string overlay_key_svg();

/// The panels with their key. Ablations are closed behind the paper's conditions.
std::string plane_overlay_figure(const std::vector<NamedSvg> &panels);
} // namespace pelvireg::report
