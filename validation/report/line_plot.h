// A line plot as SVG text: deterministic, readable without colour.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// One curve: a value an abscissa, a gap where there is none.
struct Curve
{
  std::string name;
  std::vector<std::optional<double>> values;
  std::vector<double> spreads; ///< half height of the band around each value; empty: no band
};

/// A line across the panel.
struct ReferenceLine
{
  double value = 0;
  std::string label;
};

/// One panel. Curves take colour and marker by their place in the list, at most six.
struct LinePlot
{
  std::string title, x_label, y_label;
  std::vector<double> abscissae;
  std::vector<Curve> curves;
  double y_max = 1; ///< the axis reaches to the next round number above; a value beyond it is written out
  double x_tick = 5;
  std::vector<ReferenceLine> lines;
  double y_min = 0; ///< the axis begins at the next round number below; a value below it lies on the axis
};

/// 420 x 320 units, scales with the width of the page. Throws std::invalid_argument when a curve's length differs from
/// the abscissae's, when there are none, and when y_max is not above y_min.
std::string line_plot_svg(const LinePlot &plot);

/// The key to curves of these names, as one SVG line.
std::string legend_svg(const std::vector<std::string> &names);
} // namespace pelvireg::report
