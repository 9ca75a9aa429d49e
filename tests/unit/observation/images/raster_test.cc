// Coverage of pixels by outlines against areas in closed form and against clipping each pixel by itself.
#include "synthetic/observation/images/raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector2d;

constexpr float single_precision = 2e-6f; // sums of some ten single-precision shares

PixelLoop circle(const Vector2d &centre, double radius, int n)
{
  PixelLoop loop;
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / n;
    loop.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

double area_of(const PixelLoop &loop)
{
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const Vector2d &p = loop[i], &q = loop[(i + 1) % loop.size()];
    area += 0.5 * (p.x() * q.y() - q.x() * p.y());
  }
  return area;
}

/// What of a polygon lies where sign * (coordinate - border) <= 0 (Sutherland and Hodgman 1974).
PixelLoop clipped(const PixelLoop &loop, int axis, double border, double sign)
{
  PixelLoop kept;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const Vector2d &p = loop[i], &q = loop[(i + 1) % loop.size()];
    const double a = sign * (p[axis] - border), b = sign * (q[axis] - border);
    if (a <= 0)
      kept.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0))
      kept.push_back(p + a / (a - b) * (q - p));
  }
  return kept;
}

double share_of_pixel(const PixelLoop &loop, int row, int column)
{
  return area_of(clipped(clipped(clipped(clipped(loop, 0, column + 0.5, 1), 0, column - 0.5, -1), 1, row + 0.5, 1), 1,
                         row - 0.5, -1));
}
} // namespace

TEST(Coverage, OfARectangleIsTheProductOfItsSidesShares)
{
  Raster coverage = Raster::Zero(6, 8);
  add_coverage({{0.8, 1.0}, {4.25, 1.0}, {4.25, 3.75}, {0.8, 3.75}}, coverage);
  EXPECT_NEAR(coverage(2, 2), 1, single_precision);
  EXPECT_NEAR(coverage(2, 1), 0.7, single_precision);        // from 0.8 to 1.5
  EXPECT_NEAR(coverage(2, 4), 0.75, single_precision);       // from 3.5 to 4.25
  EXPECT_NEAR(coverage(1, 4), 0.5 * 0.75, single_precision); // rows from 1.0 to 1.5
  EXPECT_NEAR(coverage(4, 1), 0.25 * 0.7, single_precision); // rows from 3.5 to 3.75
  EXPECT_NEAR(coverage(0, 2), 0, single_precision);
  EXPECT_NEAR(coverage(2, 5), 0, single_precision);
}

TEST(Coverage, OfEveryPixelIsThatOfThePixelClippedByItself)
{
  // A star: slopes of every kind, corners inside pixels, pieces over many columns.
  PixelLoop star;
  for (int i = 0; i < 14; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / 14 + 0.1, radius = i % 2 ? 4.1 : 9.3;
    star.push_back(Vector2d(10.37, 9.81) + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  Raster coverage = Raster::Zero(20, 22);
  add_coverage(star, coverage);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 22; ++column)
      EXPECT_NEAR(coverage(row, column), share_of_pixel(star, row, column), 10 * single_precision)
          << row << ' ' << column;
}

TEST(Coverage, SumsUpToTheAreaAndItsCentroid)
{
  const Vector2d centre(31.27, 28.61);
  const PixelLoop loop = circle(centre, 17.4, 400);
  Raster coverage = Raster::Zero(64, 64);
  add_coverage(loop, coverage);
  Vector2d moment = Vector2d::Zero();
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
      moment += static_cast<double>(coverage(row, column)) * Vector2d(column, row);
  const double area = static_cast<double>(coverage.sum());
  EXPECT_NEAR(area, area_of(loop), 1e-5 * area);
  // A pixel that is covered in part counts at its centre: at most half a pixel off over the rim, and the rim cancels.
  EXPECT_LT((moment / area - centre).norm(), 0.005);
}

TEST(Coverage, OfAHoleIsTakenAway)
{
  PixelLoop hole = circle({10, 10}, 4, 60);
  Raster coverage = Raster::Zero(21, 21);
  add_coverage(circle({10, 10}, 8, 60), coverage);
  std::reverse(hole.begin(), hole.end());
  add_coverage(hole, coverage);
  EXPECT_NEAR(coverage(10, 10), 0, single_precision);
  EXPECT_NEAR(coverage(10, 4), 1, single_precision);
}

TEST(Coverage, BeyondTheRasterIsCutOff)
{
  for (const Vector2d &centre : {Vector2d(-2, 5), Vector2d(11, 5), Vector2d(5, -3), Vector2d(5, 12), Vector2d(5, 5)})
  {
    const PixelLoop loop = circle(centre, 7, 50);
    Raster coverage = Raster::Zero(10, 10);
    add_coverage(loop, coverage);
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 10; ++column)
        EXPECT_NEAR(coverage(row, column), share_of_pixel(loop, row, column), 10 * single_precision);
  }
}

TEST(Refinement, KeepsTheFieldOfView)
{
  dataset::ImageGeometry geometry;
  geometry.spacing = {1.5, 2.0};
  geometry.columns = 10;
  geometry.rows = 8;
  const dataset::ImageGeometry fine = refined(geometry, 2);
  EXPECT_LT((to_point(fine, -0.5, -0.5) - to_point(geometry, -0.5, -0.5)).norm(), 1e-12);
  EXPECT_LT((to_point(fine, 19.5, 15.5) - to_point(geometry, 9.5, 7.5)).norm(), 1e-12);
  EXPECT_LT((to_pixel(geometry, to_point(geometry, 3.2, 4.7)) - Vector2d(3.2, 4.7)).norm(), 1e-12);
}
} // namespace pelvireg::observation
