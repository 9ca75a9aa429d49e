#include "validation/report/contour_error_figure.h"

#include "validation/report/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
constexpr int panel_width = 420, panel_height = 320, key_height = 30; // as line_plot.h draws them

std::vector<std::string> trackers_of(const std::vector<runner::ContourErrorRow> &rows)
{
  std::vector<std::string> names;
  for (const runner::ContourErrorRow &row : rows)
    if (std::find(names.begin(), names.end(), row.tracker) == names.end())
      names.push_back(row.tracker);
  return names;
}

LinePlot plot_of(const std::string &organ, const std::vector<runner::ContourErrorRow> &rows)
{
  LinePlot plot{
      .title = organ, .x_label = "frame", .y_label = "mean distance, mm", .abscissae = {}, .curves = {}, .lines = {}};
  plot.y_max = 0.1;
  for (const std::string &tracker : trackers_of(rows))
  {
    Curve &curve = plot.curves.emplace_back(Curve{tracker, {}, {}});
    for (const runner::ContourErrorRow &row : rows)
      if (row.tracker == tracker && row.organ == organ)
      {
        curve.values.emplace_back(row.mean);
        plot.y_max = std::max(plot.y_max, row.mean);
        if (plot.curves.size() == 1)
          plot.abscissae.push_back(row.frame);
      }
  }
  return plot;
}

/// A drawing inside another one.
std::string placed(const std::string &svg, int x, int y, int width, int height)
{
  const std::string start = "<svg ";
  return fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}", x, y, width, height,
                     svg.substr(start.size()));
}
} // namespace

std::string contour_error_figure(const std::vector<runner::ContourErrorRow> &rows)
{
  if (rows.empty())
    throw std::invalid_argument("contour_error_figure: there is no error to draw");
  const std::vector<std::string> trackers = trackers_of(rows);
  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                                "font-family=\"sans-serif\">\n{}",
                                2 * panel_width, 2 * panel_height + key_height,
                                placed(legend_svg(trackers), 0, 0, 95 * static_cast<int>(trackers.size()), 24));
  int n = 0;
  for (const std::string &organ : dataset::organ_names)
  {
    const LinePlot plot = plot_of(organ, rows);
    if (plot.abscissae.empty())
      continue;
    svg +=
        placed(line_plot_svg(plot), n % 2 * panel_width, n / 2 * panel_height + key_height, panel_width, panel_height);
    ++n;
  }
  return svg + "</svg>\n";
}
} // namespace pelvireg::report
