#include "validation/report/line_plot.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pelvireg::report
{
namespace
{
LinePlot plot()
{
  return {"title <1>", "step", "error (mm)", {1, 2, 3, 4}, {{"vagina", {1.0, 2.0, std::nullopt, 3.0}, {}}}, 3, 1, {}};
}

int count(const std::string &text, const std::string &word)
{
  int n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++n;
  return n;
}

TEST(LinePlot, LeavesAGapWhereThereIsNoValue)
{
  const std::string svg = line_plot_svg(plot());
  EXPECT_EQ(count(svg, "<circle"), 3);
  EXPECT_EQ(count(svg, "stroke-width=\"2\""), 2) << "one stretch before the gap, one after";
}

TEST(LinePlot, PutsValuesWhereTheAxesSay)
{
  // Axis to 3 in steps of 0.5; the panel's rim: x 52 … 408, y 274 … 34.
  const std::string svg = line_plot_svg(plot());
  EXPECT_NE(svg.find("<circle cx=\"52.0\" cy=\"194.0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("<circle cx=\"408.0\" cy=\"34.0\""), std::string::npos);
  EXPECT_NE(svg.find(">2.5<"), std::string::npos);
}

TEST(LinePlot, WritesOutAValueBeyondTheAxis)
{
  LinePlot outlier = plot();
  outlier.curves[0].values[1] = 95.0;
  const std::string svg = line_plot_svg(outlier);
  EXPECT_NE(svg.find(">95 ↑<"), std::string::npos);
  EXPECT_EQ(count(svg, "cy=\"34.0\""), 2) << "the outlier and the last value lie on the axis' upper end";
  EXPECT_EQ(count(svg, "cy=\"-"), 0);
}

TEST(LinePlot, ReachesBelowZeroWhenAsked)
{
  // Axis from -1 to 3 in steps of 1: the value 1 lies in the middle of 274 … 34, a value below the axis on its end.
  LinePlot change = plot();
  change.y_min = -1;
  change.curves[0].values[1] = -7.0;
  const std::string svg = line_plot_svg(change);
  EXPECT_NE(svg.find("<circle cx=\"52.0\" cy=\"154.0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find(">-1<"), std::string::npos);
  EXPECT_EQ(count(svg, "cy=\"274.0\""), 1);
  change.y_max = -1;
  EXPECT_THROW(line_plot_svg(change), std::invalid_argument);
}

TEST(LinePlot, EscapesItsText)
{
  EXPECT_NE(line_plot_svg(plot()).find("title &lt;1&gt;"), std::string::npos);
}

TEST(LinePlot, RefusesACurveOfAnotherLength)
{
  LinePlot broken = plot();
  broken.curves[0].values.pop_back();
  EXPECT_THROW(line_plot_svg(broken), std::invalid_argument);
}
} // namespace
} // namespace pelvireg::report
