#include "validation/report/plane_overlays.h"

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/plane_cut.h"
#include "validation/report/condition_order.h"
#include "validation/report/html.h"
#include "validation/report/plane_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

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

std::vector<NamedSvg> plane_overlays(const ReportInputs &inputs, const std::vector<MovingSurface> &truth_surfaces,
                                     const std::vector<ConditionSurfaces> &conditions)
{
  const dataset::Plane &plane = inputs.anatomy.dyn_plane;
  const auto last = static_cast<std::size_t>(inputs.evaluation.n_steps());
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
  std::vector<NamedSvg> panels;
  for (std::size_t i = 0; i < names.size(); ++i)
    panels.push_back({names[i], overlay_panel(condition_title(names[i]), all[0], truth, all[i + 2], view, height)});
  if (names.empty())
    panels.push_back({runner::unregistered, overlay_panel("not registered", all[0], truth, {}, view, height)});
  return panels;
}

std::string overlay_key_svg()
{
  return fmt::format("<svg viewBox=\"0 0 560 20\" font-size=\"13\" role=\"img\" aria-label=\"Key\"><path "
                     "d=\"M4 10h30\" {}/><text x=\"40\" y=\"14\">rest</text><path d=\"M104 10h30\" {}/><text "
                     "x=\"140\" y=\"14\">truth</text><path d=\"M204 10h30\" {}/><text x=\"240\" "
                     "y=\"14\">estimate</text></svg>\n",
                     rest_stroke, truth_stroke, estimate_stroke);
}

std::string plane_overlay_figure(const std::vector<NamedSvg> &panels)
{
  std::string first, others;
  for (const NamedSvg &panel : panels)
    (is_main_condition(panel.condition) ? first : others) += "<figure>" + panel.svg + "</figure>\n";
  std::string html =
      "<p class=\"key\">" + overlay_key_svg() + "</p>\n<div class=\"panels wide\">\n" + first + "</div>\n";
  return others.empty() ? html
                        : html + details("Other conditions", "<div class=\"panels wide\">\n" + others + "</div>\n");
}
} // namespace pelvireg::report
