#include "registration/tracking/closed_spline.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <stdexcept>

namespace pelvireg::tracking
{
namespace
{
/// The four blending functions of a uniform cubic B-spline, or their derivatives by t in [0, 1).
Eigen::Vector4d blending(double t, int derivative)
{
  const double s = 1 - t;
  if (derivative == 0)
    return Eigen::Vector4d(s * s * s, 3 * t * t * t - 6 * t * t + 4, -3 * t * t * t + 3 * t * t + 3 * t + 1,
                           t * t * t) /
           6;
  if (derivative == 1)
    return Eigen::Vector4d(-s * s, 3 * t * t - 4 * t, -3 * t * t + 2 * t + 1, t * t) / 2;
  return {s, 3 * t - 2, -3 * t + 1, t};
}

struct Span
{
  int index = 0; ///< of the first control point
  double t = 0;
};

Span span_of(double u, int n)
{
  const double place = (u - std::floor(u)) * n;
  const int index = std::min(static_cast<int>(place), n - 1);
  return {index, place - index};
}
} // namespace

ArcLength::ArcLength(const PixelPoints &closed) : share(closed.rows())
{
  const Eigen::Index n = closed.rows();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    share[i] = perimeter;
    perimeter += (closed.row((i + 1) % n) - closed.row(i)).norm();
  }
  share /= perimeter;
}

PixelPoints even_points(const PixelPoints &closed, Eigen::Index n)
{
  const ArcLength arc(closed);
  PixelPoints points(n, 2);
  Eigen::Index segment = 0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    while (segment + 1 < closed.rows() && arc.share[segment + 1] <= share)
      ++segment;
    const bool is_last = segment + 1 == closed.rows();
    const double end = is_last ? 1.0 : arc.share[segment + 1];
    const double t = (share - arc.share[segment]) / std::max(end - arc.share[segment], 1e-12);
    points.row(i) = (1 - t) * closed.row(segment) + t * closed.row(is_last ? 0 : segment + 1);
  }
  return points;
}

ClosedSpline::ClosedSpline(const PixelPoints &points, const Eigen::VectorXd &u, int n_controls)
{
  const int n = n_controls;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(points.rows(), n);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    const Span span = span_of(u[i], n);
    const Eigen::Vector4d weight = blending(span.t, 0);
    for (int k = 0; k < 4; ++k)
      rows(i, (span.index + k) % n) += weight[k];
  }
  Eigen::MatrixXd bending = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
  {
    bending(i, i) -= 2;
    bending(i, (i + 1) % n) += 1;
    bending(i, (i + n - 1) % n) += 1;
  }
  const double weight = 1e-4 * static_cast<double>(points.rows()) / n;
  controls_ =
      (rows.transpose() * rows + weight * bending.transpose() * bending).ldlt().solve(rows.transpose() * points);
}

Eigen::Vector2d ClosedSpline::evaluate(double u, int derivative) const
{
  const int n = static_cast<int>(controls_.rows());
  const Span span = span_of(u, n);
  const Eigen::Vector4d weight = blending(span.t, derivative);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 0; k < 4; ++k)
    sum += weight[k] * controls_.row((span.index + k) % n).transpose();
  return sum * std::pow(n, derivative);
}

double ClosedSpline::curvature(double u) const
{
  const Eigen::Vector2d d = evaluate(u, 1), dd = evaluate(u, 2);
  return (d.x() * dd.y() - d.y() * dd.x()) / std::max(std::pow(d.norm(), 3), 1e-12);
}

PixelPoints spline_outline(const PixelPoints &clicks, double spacing)
{
  if (clicks.rows() < 3)
    throw std::invalid_argument("spline_outline: " + std::to_string(clicks.rows()) +
                                " points are given, at least 3 are needed; click more points round the organ");
  if (!(spacing > 0))
    throw std::invalid_argument("spline_outline: spacing is " + std::to_string(spacing) + " px, must be positive");
  const Eigen::Index n = clicks.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    if (!((clicks.row((i + 1) % n) - clicks.row(i)).norm() > 1e-6))
      throw std::invalid_argument("spline_outline: point " + std::to_string(i) +
                                  " (0-based) and the next are equal; remove one");

  // Periodic cubic interpolation through the clicks with chord length as parameter: continuous second derivatives m.
  const ArcLength arc(clicks);
  Eigen::VectorXd h(n);
  for (Eigen::Index i = 0; i < n; ++i)
    h[i] = ((i + 1 < n ? arc.share[i + 1] : 1.0) - arc.share[i]) * arc.perimeter;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  PixelPoints right(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::Index before = (i + n - 1) % n, after = (i + 1) % n;
    system(i, before) += h[before];
    system(i, i) += 2 * (h[before] + h[i]);
    system(i, after) += h[i];
    right.row(i) = 6 * ((clicks.row(after) - clicks.row(i)) / h[i] - (clicks.row(i) - clicks.row(before)) / h[before]);
  }
  const PixelPoints m = system.partialPivLu().solve(right);
  std::vector<Eigen::RowVector2d> points;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::Index after = (i + 1) % n;
    const int pieces = std::max(1, static_cast<int>(std::ceil(h[i] / spacing)));
    for (int k = 0; k < pieces; ++k)
    {
      const double b = h[i] * k / pieces, a = h[i] - b;
      points.push_back(m.row(i) * (a * a * a / (6 * h[i]) - a * h[i] / 6) +
                       m.row(after) * (b * b * b / (6 * h[i]) - b * h[i] / 6) + clicks.row(i) * (a / h[i]) +
                       clicks.row(after) * (b / h[i]));
    }
  }
  PixelPoints outline(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    outline.row(static_cast<Eigen::Index>(i)) = points[i];
  return outline;
}
} // namespace pelvireg::tracking
