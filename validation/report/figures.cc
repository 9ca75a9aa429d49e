#include "validation/report/figures.h"

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/statistics.h"
#include "validation/report/condition_order.h"
#include "validation/report/html.h"
#include "validation/runner/aggregate.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

/// One scale for all panels. A few outliers (a slice that grazes one end of an organ) must not flatten every curve:
/// when the largest value is more than three times the 95th percentile, the axis ends at twice that percentile.
double common_scale(const std::vector<NamedPlot> &plots)
{
  std::vector<double> values;
  for (const NamedPlot &plot : plots)
    for (const Curve &curve : plot.plot.curves)
      for (std::size_t i = 0; i < curve.values.size(); ++i)
        if (curve.values[i])
          values.push_back(*curve.values[i] + (curve.spreads.empty() ? 0.0 : curve.spreads[i]));
  if (values.empty())
    return 1;
  const metrics::Statistics statistics = metrics::describe(values);
  const double scale = statistics.max > 3 * statistics.p95 ? 2 * statistics.p95 : statistics.max;
  return scale > 0 ? scale : 1;
}

std::vector<NamedPlot> with_common_scale(std::vector<NamedPlot> plots)
{
  const double y_max = common_scale(plots);
  for (NamedPlot &plot : plots)
    plot.plot.y_max = y_max;
  return plots;
}

Curve step_curve(const runner::Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  Curve curve{organ, {}, {}};
  for (const runner::Aggregate &step : runner::error_by_step(evaluation, condition, organ))
  {
    curve.values.emplace_back(step.mean);
    curve.spreads.push_back(step.sd);
  }
  return curve;
}

Curve slice_curve(const runner::Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  Curve curve{organ, {}, {}};
  for (const auto &slice : runner::error_by_slice(evaluation, condition, organ))
  {
    curve.values.push_back(slice ? std::optional(slice->mean) : std::nullopt);
    curve.spreads.push_back(slice ? slice->sd : 0.0);
  }
  return curve;
}
} // namespace

std::vector<NamedPlot> error_by_step_plots(const runner::Evaluation &evaluation)
{
  std::vector<NamedPlot> plots;
  for (const std::string &condition : reading_order(evaluation))
  {
    LinePlot plot{condition_title(condition), "registration step", "mean surface error (mm)", {}, {}, 1, 5, {}};
    plot.lines.push_back({4, "paper: below 4 mm"});
    for (int step = 1; step <= evaluation.n_steps(); ++step)
      plot.abscissae.push_back(step);
    for (const std::string &organ : organ_names)
      plot.curves.push_back(step_curve(evaluation, condition, organ));
    plots.push_back({condition, plot});
  }
  return with_common_scale(std::move(plots));
}

std::vector<NamedPlot> error_by_slice_plots(const runner::Evaluation &evaluation)
{
  std::vector<NamedPlot> plots;
  for (const std::string &condition : reading_order(evaluation))
  {
    LinePlot plot{
        condition_title(condition), "slice index (0: DYN plane)", "mean contour error (mm)", {}, {}, 1, 1, {}};
    for (int k = -evaluation.n_slices_each_side; k <= evaluation.n_slices_each_side; ++k)
      plot.abscissae.push_back(k);
    for (const std::string &organ : organ_names)
      plot.curves.push_back(slice_curve(evaluation, condition, organ));
    plots.push_back({condition, plot});
  }
  return with_common_scale(std::move(plots));
}

std::string panels_html(const std::vector<NamedPlot> &plots)
{
  std::string first, others;
  for (const NamedPlot &plot : plots)
    (is_main_condition(plot.condition) ? first : others) += "<figure>" + line_plot_svg(plot.plot) + "</figure>\n";
  std::string html = "<div class=\"legend\">" + legend_svg(organ_names) + "</div><div class=\"panels\">\n" +
                     (first.empty() ? others : first) + "</div>\n";
  if (!first.empty() && !others.empty())
    html += details("Other conditions", "<div class=\"panels\">\n" + others + "</div>\n");
  return html;
}
} // namespace pelvireg::report
