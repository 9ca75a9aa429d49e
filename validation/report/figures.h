// The figures of the report.
#pragma once

#include "validation/report/report.h"

#include <string>

namespace pelvireg::report
{
/// Both rows of the paper's Figure 6: mean surface error by step, mean contour error by slice at the last step; one
/// panel a condition, one scale a row.
std::string error_by_step_figure(const runner::Evaluation &evaluation);
std::string error_by_slice_figure(const runner::Evaluation &evaluation);

/// Contours of rest, truth and estimate in the DYN plane at the last step, from the judge's own slicer; one panel a
/// registered condition.
std::string plane_overlay_figure(const ReportInputs &inputs);

/// What a condition is called in headings: "full (all constraints)", …
std::string condition_title(const std::string &condition);
} // namespace pelvireg::report
