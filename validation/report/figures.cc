#include "validation/report/figures.h"

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/plane_cut.h"
#include "validation/metrics/statistics.h"
#include "validation/report/condition_order.h"
#include "validation/report/html.h"
#include "validation/report/plane_view.h"
#include "validation/runner/aggregate.h"

#include <fmt/format.h>

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

/// From mm in space to units of the drawing.
struct ScaledView
{
  PlaneView flat;
  double scale = 1, x_offset = 0, y_offset = 0;

  Eigen::Vector2d operator()(const Eigen::Vector3d &p) const
  {
    return scale * flat(p) + Eigen::Vector2d(x_offset, y_offset);
  }
};

/// One set of contours, all organs.
using Cuts = std::vector<std::vector<metrics::CutSegment>>;

Cuts cut_all(const std::vector<MovingSurface> &organs, std::size_t frame, const dataset::Plane &plane)
{
  Cuts cuts;
  for (const MovingSurface &organ : organs)
    cuts.push_back(metrics::cut_surface(organ.at(frame), organ.rest.triangles, organ.rest.region, plane));
  return cuts;
}

std::string draw(const Cuts &cuts, const ScaledView &view, const std::string &stroke)
{
  std::string path;
  for (const auto &organ : cuts)
    for (const metrics::CutSegment &segment : organ)
    {
      const Eigen::Vector2d a = view(segment.ends[0].position), b = view(segment.ends[1].position);
      path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
    }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke-linecap=\"round\" {}/>\n", path, stroke);
}

/// Scale and shift the view so that all contours fit; returns the drawing's height for a width of 560.
double fit(ScaledView &view, const std::vector<Cuts> &all)
{
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300), upper = -lower;
  for (const Cuts &cuts : all)
    for (const auto &organ : cuts)
      for (const metrics::CutSegment &segment : organ)
      {
        lower = lower.cwiseMin(view.flat(segment.ends[0].position));
        upper = upper.cwiseMax(view.flat(segment.ends[0].position));
      }
  constexpr double width = 560, greatest_height = 560, margin = 24;
  const Eigen::Vector2d extent = (upper - lower).cwiseMax(1.0);
  view.scale = std::min((width - 2 * margin) / extent.x(), greatest_height / extent.y());
  view.x_offset = width / 2 - view.scale * (lower.x() + upper.x()) / 2;
  view.y_offset = margin + 24 - view.scale * lower.y();
  return view.scale * (upper.y() - lower.y()) + 2 * margin + 48;
}

std::string organ_labels(const Cuts &truth, const ScaledView &view)
{
  std::string svg;
  for (std::size_t organ = 0; organ < truth.size(); ++organ)
  {
    Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300), upper = -lower;
    for (const metrics::CutSegment &segment : truth[organ])
    {
      lower = lower.cwiseMin(view(segment.ends[0].position));
      upper = upper.cwiseMax(view(segment.ends[0].position));
    }
    if (!truth[organ].empty())
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#444\">{}</text>\n",
                         (lower.x() + upper.x()) / 2, (lower.y() + upper.y()) / 2, escape(organ_names[organ]));
  }
  return svg;
}

const std::string rest_stroke = "stroke=\"#a8a8a8\" stroke-width=\"1.2\"";
const std::string truth_stroke = "stroke=\"#000\" stroke-width=\"2.6\"";
const std::string estimate_stroke = "stroke=\"#D55E00\" stroke-width=\"1.6\"";

std::string overlay_panel(const std::string &title, const Cuts &rest, const Cuts &truth, const Cuts &estimate,
                          const ScaledView &view, double height)
{
  const double bar = 20 * view.scale;
  std::string svg = fmt::format("<svg viewBox=\"0 0 560 {:.0f}\" role=\"img\" aria-label=\"{}\" font-size=\"13\">\n",
                                height, escape("Contours in the DYN plane: " + title));
  svg += fmt::format("<text x=\"280\" y=\"18\" text-anchor=\"middle\" font-weight=\"600\" font-size=\"15\">{}</text>\n",
                     escape(title));
  svg += draw(rest, view, rest_stroke) + draw(truth, view, truth_stroke) + draw(estimate, view, estimate_stroke);
  svg += organ_labels(truth, view);
  svg += fmt::format("<path d=\"M24 {0:.1f}h{1:.1f}\" stroke=\"#000\" stroke-width=\"3\"/>"
                     "<text x=\"{2:.1f}\" y=\"{3:.1f}\">20 mm</text>\n",
                     height - 14, bar, 32 + bar, height - 10);
  return svg + "</svg>\n";
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

std::string plane_overlay_figure(const ReportInputs &inputs, const std::vector<MovingSurface> &truth_surfaces,
                                 const std::vector<ConditionSurfaces> &conditions)
{
  const dataset::Plane &plane = inputs.anatomy.dyn_plane;
  const std::size_t last = static_cast<std::size_t>(inputs.evaluation.n_steps());
  const Cuts truth = cut_all(truth_surfaces, last, plane);
  std::vector<Cuts> all = {{}, truth};
  std::vector<std::string> names;
  for (const std::string &name : reading_order(inputs.evaluation))
    for (const ConditionSurfaces &condition : conditions)
      if (condition.condition == runner::unregistered && name == condition.condition)
        all[0] = cut_all(condition.organs, 0, plane);
      else if (condition.condition == name)
      {
        all.push_back(cut_all(condition.organs, last, plane));
        names.push_back(name);
      }
  ScaledView view{PlaneView(plane)};
  const double height = fit(view, all);
  std::string html = fmt::format("<p class=\"key\"><svg viewBox=\"0 0 560 20\" font-size=\"13\" role=\"img\" "
                                 "aria-label=\"Key\"><path d=\"M4 10h30\" {}/><text x=\"40\" y=\"14\">rest</text>"
                                 "<path d=\"M104 10h30\" {}/><text x=\"140\" y=\"14\">truth</text>"
                                 "<path d=\"M204 10h30\" {}/><text x=\"240\" y=\"14\">estimate</text></svg></p>\n",
                                 rest_stroke, truth_stroke, estimate_stroke);
  std::string first, others;
  for (std::size_t i = 0; i < names.size(); ++i)
    (is_main_condition(names[i]) ? first : others) +=
        "<figure>" + overlay_panel(condition_title(names[i]), all[0], truth, all[i + 2], view, height) + "</figure>\n";
  if (names.empty())
    first = "<figure>" + overlay_panel("not registered", all[0], truth, {}, view, height) + "</figure>\n";
  html += "<div class=\"panels wide\">\n" + first + "</div>\n";
  return others.empty() ? html : html + details("Other conditions", "<div class=\"panels wide\">\n" + others + "</div>\n");
}
} // namespace pelvireg::report
