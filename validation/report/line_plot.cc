#include "validation/report/line_plot.h"

#include "validation/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
constexpr double width = 420, height = 320, left = 52, right = 12, top = 34, bottom = 46;

// Okabe and Ito 2008, without the yellows that vanish on white.
const std::array<const char *, 6> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000"};

/// Least step of 1, 2, 5 times a power of ten that needs at most six of them.
double tick_step(double reach)
{
  double step = std::pow(10, std::floor(std::log10(reach)) - 1);
  for (const double factor : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0})
    if (reach / step > 6)
      step *= factor;
  return step;
}

struct Axes
{
  double x_min, x_max, y_min, y_max, y_step;

  static double y_max_position() { return top; }
  double x(double value) const { return left + (value - x_min) / (x_max - x_min) * (width - left - right); }
  /// A value beyond the axis lies on its end.
  double y(double value) const
  {
    const double share = std::clamp((value - y_min) / (y_max - y_min), 0.0, 1.0);
    return height - bottom - share * (height - top - bottom);
  }
};

Axes axes_of(const LinePlot &plot)
{
  if (plot.abscissae.empty() || !(plot.y_max > plot.y_min))
    throw std::invalid_argument("line plot: needs at least one abscissa and a y_max above y_min");
  const auto [lowest, highest] = std::minmax_element(plot.abscissae.begin(), plot.abscissae.end());
  const double step = tick_step(plot.y_max - plot.y_min);
  const double margin = *lowest == *highest ? 1 : 0;
  return {*lowest - margin, *highest + margin, step * std::floor(plot.y_min / step + 1e-9),
          step * std::ceil(plot.y_max / step - 1e-9), step};
}

std::string text_at(double x, double y, const std::string &anchor, const std::string &text,
                    const std::string &extra = "")
{
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, extra,
                     escape(text));
}

std::string frame(const LinePlot &plot, const Axes &axes)
{
  std::string svg;
  const int n_ticks = static_cast<int>(std::lround((axes.y_max - axes.y_min) / axes.y_step));
  for (int i = 0; i <= n_ticks; ++i)
  {
    const double value = (std::round(axes.y_min / axes.y_step) + i) * axes.y_step;
    svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", left,
                       width - right, axes.y(value), axes.y(value));
    svg += text_at(left - 6, axes.y(value) + 4, "end", fmt::format("{:g}", value));
  }
  const double first = std::ceil(axes.x_min / plot.x_tick) * plot.x_tick;
  for (double value = first; value <= axes.x_max + 1e-9; value += plot.x_tick)
  {
    svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#666\"/>\n",
                       axes.x(value), axes.x(value), height - bottom, height - bottom + 4);
    svg += text_at(axes.x(value), height - bottom + 17, "middle", fmt::format("{:g}", value));
  }
  svg += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" fill=\"none\" stroke=\"#666\"/>\n", left, top,
                     height - bottom, width - right);
  svg += text_at((left + width - right) / 2, height - 10, "middle", plot.x_label);
  svg += text_at(14, (top + height - bottom) / 2, "middle", plot.y_label,
                 fmt::format(" transform=\"rotate(-90 14 {:.1f})\"", (top + height - bottom) / 2));
  svg += text_at((left + width - right) / 2, 20, "middle", plot.title, " font-weight=\"600\" font-size=\"14\"");
  return svg;
}

std::string marker(std::size_t curve, double x, double y)
{
  const char *colour = colours[curve];
  switch (curve % 4)
  {
  case 0:
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"{}\"/>\n", x, y, colour);
  case 1:
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"{}\"/>\n", x - 3, y - 3,
                       colour);
  case 2:
    return fmt::format("<path d=\"M{:.1f} {:.1f}l4 7h-8z\" fill=\"{}\"/>\n", x, y - 4, colour);
  default:
    return fmt::format("<path d=\"M{:.1f} {:.1f}l4 4l-4 4l-4 -4z\" fill=\"{}\"/>\n", x, y - 4, colour);
  }
}

/// Connected stretches of a curve: index ranges [begin, end) without a gap.
std::vector<std::pair<std::size_t, std::size_t>> stretches(const Curve &curve)
{
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (std::size_t i = 0; i < curve.values.size(); ++i)
    if (curve.values[i])
    {
      if (i == 0 || !curve.values[i - 1])
        ranges.emplace_back(i, i);
      ranges.back().second = i + 1;
    }
  return ranges;
}

std::string band(const LinePlot &plot, const Axes &axes, std::size_t c)
{
  const Curve &curve = plot.curves[c];
  std::string svg;
  for (const auto &[begin, end] : stretches(curve))
  {
    std::string upper, lower;
    for (std::size_t i = begin; i < end; ++i)
    {
      const double x = axes.x(plot.abscissae[i]);
      const double above = std::min(*curve.values[i] + curve.spreads[i], axes.y_max);
      const double below = std::max(*curve.values[i] - curve.spreads[i], axes.y_min);
      upper += fmt::format("{}{:.1f} {:.1f}", upper.empty() ? "M" : "L", x, axes.y(above));
      lower = fmt::format("L{:.1f} {:.1f}", x, axes.y(below)) + lower;
    }
    svg += fmt::format("<path d=\"{}{}Z\" fill=\"{}\" fill-opacity=\"0.2\"/>\n", upper, lower, colours[c]);
  }
  return svg;
}

std::string curve_svg(const LinePlot &plot, const Axes &axes, std::size_t c)
{
  const Curve &curve = plot.curves[c];
  if (curve.values.size() != plot.abscissae.size() ||
      (!curve.spreads.empty() && curve.spreads.size() != curve.values.size()))
    throw std::invalid_argument(fmt::format("line plot: curve '{}' has {} values and {} spreads for {} abscissae",
                                            curve.name, curve.values.size(), curve.spreads.size(),
                                            plot.abscissae.size()));
  std::string svg = curve.spreads.empty() ? "" : band(plot, axes, c);
  for (const auto &[begin, end] : stretches(curve))
  {
    std::string path;
    for (std::size_t i = begin; i < end; ++i)
      path +=
          fmt::format("{}{:.1f} {:.1f}", i == begin ? "M" : "L", axes.x(plot.abscissae[i]), axes.y(*curve.values[i]));
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, colours[c]);
  }
  // About ten markers a curve, the last point always.
  const std::size_t stride = std::max<std::size_t>(1, plot.abscissae.size() / 15);
  for (std::size_t i = (plot.abscissae.size() - 1) % stride; i < plot.abscissae.size(); i += stride)
    if (curve.values[i])
      svg += marker(c, axes.x(plot.abscissae[i]), axes.y(*curve.values[i]));
  for (std::size_t i = 0; i < plot.abscissae.size(); ++i)
    if (curve.values[i] && *curve.values[i] > axes.y_max)
      svg += text_at(axes.x(plot.abscissae[i]) - 6, axes.y_max_position() + 4, "end",
                     fmt::format("{:.0f} ↑", *curve.values[i]), fmt::format(" fill=\"{}\"", colours[c]));
  return svg;
}

std::string open_svg(double svg_width, double svg_height, const std::string &label)
{
  return fmt::format("<svg viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\" font-size=\"12\">\n", svg_width,
                     svg_height, escape(label));
}
} // namespace

std::string line_plot_svg(const LinePlot &plot)
{
  const Axes axes = axes_of(plot);
  std::string svg = open_svg(width, height, plot.title + ": " + plot.y_label + " against " + plot.x_label);
  svg += frame(plot, axes);
  for (const ReferenceLine &line : plot.lines)
    if (line.value >= axes.y_min && line.value <= axes.y_max)
    {
      svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#333\" "
                         "stroke-dasharray=\"6 4\"/>\n",
                         left, width - right, axes.y(line.value), axes.y(line.value));
      svg += text_at(left + 6, axes.y(line.value) - 5, "start", line.label);
    }
  for (std::size_t c = 0; c < std::min(plot.curves.size(), colours.size()); ++c)
    svg += curve_svg(plot, axes, c);
  return svg + "</svg>\n";
}

std::string legend_svg(const std::vector<std::string> &names)
{
  constexpr double pitch = 95;
  std::string svg = open_svg(pitch * static_cast<double>(names.size()), 24, "Key");
  for (std::size_t i = 0; i < names.size() && i < colours.size(); ++i)
  {
    const double x = pitch * static_cast<double>(i) + 6;
    svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"12\" y2=\"12\" stroke=\"{}\" stroke-width=\"2\"/>\n", x,
                       x + 24, colours[i]);
    svg += marker(i, x + 12, 12) + text_at(x + 30, 16, "start", names[i]);
  }
  return svg + "</svg>\n";
}
} // namespace pelvireg::report
