// The error curves of the report.
#pragma once

#include "validation/report/line_plot.h"
#include "validation/runner/evaluate.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// A panel of one condition.
struct NamedPlot
{
  std::string condition;
  LinePlot plot;
};

/// Both rows of the paper's Figures 6 and 7: mean surface error by step, mean contour error by slice at the last step;
/// one panel a condition, one scale a row.
std::vector<NamedPlot> error_by_step_plots(const runner::Evaluation &evaluation);
std::vector<NamedPlot> error_by_slice_plots(const runner::Evaluation &evaluation);

/// A row of panels with their key. Ablations are closed behind the paper's conditions.
std::string panels_html(const std::vector<NamedPlot> &plots);
} // namespace pelvireg::report
