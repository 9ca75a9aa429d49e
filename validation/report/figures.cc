#include "validation/report/figures.h"

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/plane_cut.h"
#include "validation/metrics/statistics.h"
#include "validation/report/html.h"
#include "validation/report/line_plot.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/evaluate_checks.h"
#include "validation/runner/outer_surface.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

/// Left to right as in the paper: with boundary conditions, without, then nothing at all.
std::vector<std::string> panel_order(const runner::Evaluation &evaluation)
{
  std::vector<std::string> order = evaluation.conditions;
  std::reverse(order.begin(), order.end());
  const auto full = std::find(order.begin(), order.end(), "full");
  if (full != order.end())
    std::rotate(order.begin(), full, full + 1);
  return order;
}

/// One scale for all panels. A few outliers (a slice that grazes one end of an organ) must not flatten every curve:
/// when the largest value is more than three times the 95th percentile, the axis ends at twice that percentile.
double common_scale(const std::vector<LinePlot> &plots)
{
  std::vector<double> values;
  for (const LinePlot &plot : plots)
    for (const Curve &curve : plot.curves)
      for (std::size_t i = 0; i < curve.values.size(); ++i)
        if (curve.values[i])
          values.push_back(*curve.values[i] + (curve.spreads.empty() ? 0.0 : curve.spreads[i]));
  if (values.empty())
    return 1;
  const metrics::Statistics statistics = metrics::describe(values);
  const double scale = statistics.max > 3 * statistics.p95 ? 2 * statistics.p95 : statistics.max;
  return scale > 0 ? scale : 1;
}

std::string row_of_panels(std::vector<LinePlot> plots)
{
  const double y_max = common_scale(plots);
  std::string html = "<div class=\"legend\">" + legend_svg(organ_names) + "</div><div class=\"panels\">\n";
  for (LinePlot &plot : plots)
  {
    plot.y_max = y_max;
    html += "<figure>" + line_plot_svg(plot) + "</figure>\n";
  }
  return html + "</div>\n";
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

/// From mm in space to units of the drawing: posterior to the right, superior up, as seen from the left.
struct PlaneView
{
  Eigen::Vector3d origin, right, up;
  double scale = 1, x_offset = 0, y_offset = 0;

  explicit PlaneView(const dataset::Plane &plane) : origin(plane.origin)
  {
    up = (Eigen::Vector3d::UnitZ() - plane.normal.z() * plane.normal).normalized();
    right = up.cross(plane.normal);
  }
  Eigen::Vector2d flat(const Eigen::Vector3d &p) const { return {right.dot(p - origin), -up.dot(p - origin)}; }
  Eigen::Vector2d operator()(const Eigen::Vector3d &p) const
  {
    return scale * flat(p) + Eigen::Vector2d(x_offset, y_offset);
  }
};

/// One set of contours, all organs.
using Cuts = std::vector<std::vector<metrics::CutSegment>>;

Cuts cut_all(const std::vector<dataset::SurfaceMesh> &surfaces, const dataset::Plane &plane)
{
  Cuts cuts;
  for (const dataset::SurfaceMesh &surface : surfaces)
    cuts.push_back(metrics::cut_surface(surface.points, surface.triangles, surface.region, plane));
  return cuts;
}

std::string draw(const Cuts &cuts, const PlaneView &view, const std::string &stroke)
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

std::vector<dataset::SurfaceMesh> truth_at_end(const dataset::Truth &truth)
{
  std::vector<dataset::SurfaceMesh> surfaces;
  for (const std::string &organ : organ_names)
  {
    const dataset::TruthSurface &surface = runner::truth_surface(truth, organ);
    surfaces.push_back(surface.rest);
    surfaces.back().points += surface.displacements.back();
  }
  return surfaces;
}

std::vector<dataset::SurfaceMesh> rest_of(const dataset::Anatomy &anatomy)
{
  std::vector<dataset::SurfaceMesh> surfaces;
  for (const std::string &organ : organ_names)
  {
    const auto body = static_cast<std::size_t>(runner::body_index(anatomy.registration, organ));
    surfaces.push_back(runner::outer_surface(anatomy.registration.bodies[body]).rest);
  }
  return surfaces;
}

std::vector<dataset::SurfaceMesh> estimate_at_end(const dataset::EstimateSample &sample)
{
  std::vector<dataset::SurfaceMesh> surfaces;
  for (const dataset::EstimateSurface &surface : sample.surfaces)
    surfaces.push_back({surface.positions.back(), surface.rest.triangles, surface.rest.region});
  return surfaces;
}

const dataset::EstimateSample *nominal_run(const dataset::Estimate &estimate)
{
  for (const dataset::EstimateSample &sample : estimate.samples)
    if (sample.sample == 0)
      return &sample;
  return nullptr;
}

/// Scale and shift the view so that all contours fit; returns the drawing's height for a width of 560.
double fit(PlaneView &view, const std::vector<Cuts> &all)
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

std::string organ_labels(const Cuts &truth, const PlaneView &view)
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
                          const PlaneView &view, double height)
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

std::string condition_title(const std::string &condition)
{
  if (condition == "full")
    return "full: with boundary conditions";
  if (condition == "no_boundary_conditions")
    return "without boundary conditions";
  if (condition == runner::unregistered)
    return "unregistered: the rest mesh";
  return condition;
}

std::string error_by_step_figure(const runner::Evaluation &evaluation)
{
  std::vector<LinePlot> plots;
  for (const std::string &condition : panel_order(evaluation))
  {
    LinePlot plot{condition_title(condition), "registration step", "mean surface error (mm)", {}, {}, 1, 5, {}};
    plot.lines.push_back({4, "paper: below 4 mm"});
    for (int step = 1; step <= evaluation.n_steps(); ++step)
      plot.abscissae.push_back(step);
    for (const std::string &organ : organ_names)
      plot.curves.push_back(step_curve(evaluation, condition, organ));
    plots.push_back(plot);
  }
  return row_of_panels(plots);
}

std::string error_by_slice_figure(const runner::Evaluation &evaluation)
{
  std::vector<LinePlot> plots;
  for (const std::string &condition : panel_order(evaluation))
  {
    LinePlot plot{
        condition_title(condition), "slice index (0: DYN plane)", "mean contour error (mm)", {}, {}, 1, 1, {}};
    for (int k = -evaluation.n_slices_each_side; k <= evaluation.n_slices_each_side; ++k)
      plot.abscissae.push_back(k);
    for (const std::string &organ : organ_names)
      plot.curves.push_back(slice_curve(evaluation, condition, organ));
    plots.push_back(plot);
  }
  return row_of_panels(plots);
}

std::string plane_overlay_figure(const ReportInputs &inputs)
{
  const dataset::Plane &plane = inputs.anatomy.dyn_plane;
  const Cuts rest = cut_all(rest_of(inputs.anatomy), plane);
  const Cuts truth = cut_all(truth_at_end(inputs.truth), plane);
  std::vector<Cuts> all = {rest, truth};
  std::vector<std::string> titles;
  for (const std::string &condition : panel_order(inputs.evaluation))
    for (const dataset::Estimate &estimate : inputs.estimates)
      if (const dataset::EstimateSample *run = nominal_run(estimate); run && estimate.label() == condition)
      {
        all.push_back(cut_all(estimate_at_end(*run), plane));
        titles.push_back(condition_title(condition));
      }
  PlaneView view(plane);
  const double height = fit(view, all);
  std::string html = fmt::format("<p class=\"key\"><svg viewBox=\"0 0 560 20\" font-size=\"13\" role=\"img\" "
                                 "aria-label=\"Key\"><path d=\"M4 10h30\" {}/><text x=\"40\" y=\"14\">rest</text>"
                                 "<path d=\"M104 10h30\" {}/><text x=\"140\" y=\"14\">truth</text>"
                                 "<path d=\"M204 10h30\" {}/><text x=\"240\" y=\"14\">estimate</text></svg></p>\n",
                                 rest_stroke, truth_stroke, estimate_stroke);
  html += "<div class=\"panels wide\">\n";
  for (std::size_t i = 0; i < titles.size(); ++i)
    html += "<figure>" + overlay_panel(titles[i], rest, truth, all[i + 2], view, height) + "</figure>\n";
  if (titles.empty())
    html += "<figure>" + overlay_panel("not registered", rest, truth, {}, view, height) + "</figure>\n";
  return html + "</div>\n";
}
} // namespace pelvireg::report
