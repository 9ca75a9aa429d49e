#include "registration/tracking/bezier_outline.h"
#include "registration/tracking/closed_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::tracking
{
namespace
{
PixelPoints circle(double radius, int n, const Eigen::RowVector2d &centre = {40, 40})
{
  PixelPoints points(n, 2);
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2 * std::numbers::pi * i / n;
    points.row(i) = centre + radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
  }
  return points;
}

PixelPoints rectangle(double half_width, double half_height)
{
  std::vector<Eigen::RowVector2d> points;
  const auto side = [&](const Eigen::RowVector2d &a, const Eigen::RowVector2d &b)
  {
    const int n = static_cast<int>(std::ceil((b - a).norm()));
    for (int i = 0; i < n; ++i)
      points.push_back(a + (b - a) * i / n);
  };
  const Eigen::RowVector2d centre(40, 40), a(-half_width, -half_height), b(half_width, -half_height);
  side(centre + a, centre + b);
  side(centre + b, centre - a);
  side(centre - a, centre - b);
  side(centre - b, centre + a);
  PixelPoints all(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    all.row(static_cast<Eigen::Index>(i)) = points[i];
  return all;
}
} // namespace

TEST(ClosedSpline, OfACircleHasItsCurvatureEverywhere)
{
  const PixelPoints points = circle(20, 120);
  const ClosedSpline spline(points, ArcLength(points).share, 32);
  for (double u = 0; u < 1; u += 0.013)
  {
    EXPECT_NEAR((spline.position(u) - Eigen::Vector2d(40, 40)).norm(), 20, 0.01);
    EXPECT_NEAR(spline.curvature(u), 1.0 / 20, 0.002);
  }
}

TEST(SplineOutline, MeetsItsClicksAndTheCircleTheyLieOn)
{
  const PixelPoints clicks = circle(20, 12);
  const PixelPoints outline = spline_outline(clicks, 1);
  EXPECT_EQ(outline.row(0), clicks.row(0));
  for (Eigen::Index i = 0; i < clicks.rows(); ++i)
    EXPECT_LT((outline.rowwise() - clicks.row(i)).rowwise().norm().minCoeff(), 1e-9);
  for (const auto &point : outline.rowwise())
    // Cubic interpolation of a circle at 12 points: error 20 (pi/6)^4 * 5/384 = 0.02 px
    EXPECT_NEAR((point - Eigen::RowVector2d(40, 40)).norm(), 20, 0.03);
}

TEST(FitBezier, GivesTheOutlineBackExactlyEitherWayRound)
{
  for (const PixelPoints &points : {circle(15, 80), rectangle(20, 8)})
    for (const PixelPoints &given : {points, PixelPoints(points.colwise().reverse())})
    {
      const BezierFit fit = fit_bezier({"organ", given, {}, false}, {});
      EXPECT_LT((fit.points_on(fit.curve) - given).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(FitBezier, LeavesATenthOfAPixelOfASmoothOutline)
{
  const BezierFit fit = fit_bezier({"organ", circle(15, 80), {}, false}, {});
  for (const Eigen::Vector2d &remainder : fit.remainder)
    EXPECT_LT(remainder.norm(), 0.1);
}

TEST(FitBezier, PutsJointsOnTheCornersOfARectangle)
{
  const BezierFit fit = fit_bezier({"organ", rectangle(20, 10), {}, false}, {});
  int n_corners = 0;
  for (std::size_t i = 0; i < fit.is_corner.size(); ++i)
    if (fit.is_corner[i])
    {
      ++n_corners;
      const Eigen::Vector2d from_centre = (fit.curve.joints[i] - Eigen::Vector2d(40, 40)).cwiseAbs();
      EXPECT_LT((from_centre - Eigen::Vector2d(20, 10)).norm(), 1.5); // the spline rounds a corner by half its spacing
    }
  EXPECT_EQ(n_corners, 4);
}

TEST(FitBezier, HasNoCornerOnACircleOfLowCurvature)
{
  const BezierFit fit = fit_bezier({"organ", circle(15, 80), {}, false}, {});
  for (const char is_corner : fit.is_corner)
    EXPECT_FALSE(is_corner);
}

TEST(FitBezier, KeepsJointsNoFartherApartThanTheSpacing)
{
  const BezierFit fit = fit_bezier({"organ", circle(25, 200), {}, false}, {.joint_spacing = 8});
  for (std::size_t i = 0; i < fit.curve.n_segments(); ++i)
    EXPECT_LE((fit.curve.next_joint(i) - fit.curve.joints[i]).norm(), 8);
}

TEST(FitBezier, NormalsPointOutEitherWayRound)
{
  for (const PixelPoints &given : {circle(15, 80), PixelPoints(circle(15, 80).colwise().reverse())})
  {
    const BezierFit fit = fit_bezier({"organ", given, {}, false}, {});
    for (std::size_t i = 0; i < fit.curve.n_segments(); ++i)
      EXPECT_GT(fit.curve.normal(i, 0.5).dot(fit.curve.position(i, 0.5) - Eigen::Vector2d(40, 40)), 14);
  }
}

TEST(FitBezier, TakesBordersFromTheFlagsOfTheOutline)
{
  const PixelPoints points = circle(20, 120);
  std::vector<char> has_border(120, 1);
  std::fill(has_border.begin(), has_border.begin() + 60, 0); // the half with y > 40
  const BezierFit fit = fit_bezier({"organ", points, has_border, false}, {});
  for (std::size_t i = 0; i < fit.curve.n_segments(); ++i)
  {
    const double y = fit.curve.position(i, 0.5).y();
    if (std::abs(y - 40) > 5)
    {
      EXPECT_EQ(fit.has_border[i] != 0, y < 40);
    }
  }
}
} // namespace pelvireg::tracking
