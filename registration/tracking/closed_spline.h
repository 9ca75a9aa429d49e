// A closed cubic B-spline: the smooth curve behind the points of an outline.
#pragma once

#include "registration/tracking/outline_tracker.h"

namespace pelvireg::tracking
{
/// Uniform, periodic, cubic; the parameter u runs from 0 to 1 once round.
class ClosedSpline
{
public:
  /// Least-squares fit of `n_controls` (>= 4) control points to closed points (n x 2) at the parameters `u` (n, in
  /// [0, 1)). A slight bending energy keeps spans that hold no point defined.
  ClosedSpline(const PixelPoints &points, const Eigen::VectorXd &u, int n_controls);

  Eigen::Vector2d position(double u) const { return evaluate(u, 0); }
  Eigen::Vector2d first_derivative(double u) const { return evaluate(u, 1); }
  /// 1/px, positive where the curve turns to the left in x, y order.
  double curvature(double u) const;

private:
  Eigen::Vector2d evaluate(double u, int derivative) const;

  PixelPoints controls_; ///< n x 2
};

/// Share of the perimeter before each point of a closed polyline (n, from 0), and the perimeter, px.
struct ArcLength
{
  explicit ArcLength(const PixelPoints &closed);
  Eigen::VectorXd share;
  double perimeter = 0;
};

/// n points at equal shares of a closed polyline's length, the first at its first point.
PixelPoints even_points(const PixelPoints &closed, Eigen::Index n);
} // namespace pelvireg::tracking
