#include "validation/report/contour_error_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace pelvireg::report
{
namespace
{
std::size_t count(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}
} // namespace

TEST(ContourErrorFigure, HasAPanelAnOrganAndACurveATracker)
{
  std::vector<runner::ContourErrorRow> rows;
  for (const char *tracker : {"bezier", "snake"})
    for (const std::string &organ : {std::string("bladder"), std::string("rectum")})
      for (int frame = 0; frame < 5; ++frame)
        rows.push_back({tracker, organ, frame, 10, 0.1 * frame, 0, 0, 0});
  const std::string svg = contour_error_figure(rows);
  EXPECT_EQ(count(svg, "<svg "), 4u); // the document, the key, two panels
  EXPECT_EQ(count(svg, "</svg>"), 4u);
  EXPECT_EQ(count(svg, "<path "), 6u); // four curves, two pairs of axes
  EXPECT_THAT(svg, testing::AllOf(testing::HasSubstr("bladder"), testing::HasSubstr("rectum"),
                                  testing::HasSubstr("snake"), testing::Not(testing::HasSubstr("uterus"))));
}

TEST(ContourErrorFigure, RefusesToDrawNothing) { EXPECT_THROW(contour_error_figure({}), std::invalid_argument); }
} // namespace pelvireg::report
