#include "validation/report/contour_error_figure.h"

#include "validation/report/line_plot.h"
#include "validation/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace pelvireg::report
{
namespace
{
constexpr double key_height = 30;

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
} // namespace

std::string contour_error_figure(const std::vector<runner::ContourErrorRow> &rows)
{
  if (rows.empty())
    throw std::invalid_argument("contour_error_figure: there is no error to draw");
  const std::string key = legend_svg(trackers_of(rows));
  std::string panels;
  double width = 0, height = 0;
  int n = 0;
  for (const std::string &organ : dataset::organ_names)
  {
    const LinePlot plot = plot_of(organ, rows);
    if (plot.abscissae.empty())
      continue;
    const std::string panel = line_plot_svg(plot);
    std::tie(width, height) = size_of(panel);
    panels += placed(panel, n % 2 * width, n / 2 * height + key_height, width, height);
    ++n;
  }
  const auto [key_width, its_height] = size_of(key);
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:g} {:g}\" "
                     "font-family=\"sans-serif\">\n{}{}</svg>\n",
                     2 * width, (n + 1) / 2 * height + key_height, placed(key, 0, 0, key_width, its_height), panels);
}
} // namespace pelvireg::report
