#include "registration/tracking/bezier_outline.h"

#include "registration/tracking/closed_spline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pelvireg::tracking
{
namespace
{
constexpr int n_scan = 512; ///< parameters at which curvature is looked at

double signed_area(const PixelPoints &closed)
{
  double area = 0;
  for (Eigen::Index i = 0, n = closed.rows(); i < n; ++i)
    area += closed(i, 0) * closed((i + 1) % n, 1) - closed((i + 1) % n, 0) * closed(i, 1);
  return area / 2;
}

/// Parameters of the corners, ascending: maxima of |curvature| above the bound, none closer than `gap` (in u) to a
/// sharper one.
std::vector<double> corners_of(const ClosedSpline &spline, double bound, double gap)
{
  std::vector<double> curvature(n_scan);
  for (int i = 0; i < n_scan; ++i)
    curvature[static_cast<std::size_t>(i)] = std::abs(spline.curvature(static_cast<double>(i) / n_scan));
  std::vector<int> order(n_scan);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b)
                   { return curvature[static_cast<std::size_t>(a)] > curvature[static_cast<std::size_t>(b)]; });
  std::vector<double> corners;
  for (const int i : order)
  {
    const double here = curvature[static_cast<std::size_t>(i)];
    const bool is_maximum = here >= curvature[static_cast<std::size_t>((i + 1) % n_scan)] &&
                            here >= curvature[static_cast<std::size_t>((i + n_scan - 1) % n_scan)];
    const double u = static_cast<double>(i) / n_scan;
    const bool is_free = std::all_of(corners.begin(), corners.end(),
                                     [&](double other) { return std::abs(std::remainder(u - other, 1.0)) >= gap; });
    if (here > bound && is_maximum && is_free)
      corners.push_back(u);
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// A spline through samples a pixel apart, so that crowded points weigh no more than others.
ClosedSpline spline_of(const PixelPoints &points, double perimeter, bool is_reversed)
{
  const Eigen::Index n = std::max<Eigen::Index>(32, std::lround(perimeter));
  Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(n, 0, 1 - 1 / static_cast<double>(n));
  if (is_reversed)
    u.tail(n - 1) = 1 - u.tail(n - 1).array();
  return {even_points(points, n), u, std::max(8, static_cast<int>(std::lround(perimeter / 4)))};
}

struct Joints
{
  std::vector<double> u; ///< ascending from the first corner; beyond 1 for those past the start
  std::vector<char> is_corner;
};

/// Corners, and between them as many more as the spacing wants.
Joints joints_of(std::vector<double> corners, double spacing)
{
  const bool has_corner = !corners.empty();
  if (!has_corner)
    corners = {0};
  Joints joints;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const double end = i + 1 < corners.size() ? corners[i + 1] : corners[0] + 1;
    // A chain of one or two segments has no shape to speak of.
    const int least = corners.size() >= 4 ? 1 : 4;
    const int pieces = std::max(least, static_cast<int>(std::ceil((end - corners[i]) / spacing)));
    for (int k = 0; k < pieces; ++k)
    {
      joints.u.push_back(corners[i] + (end - corners[i]) * k / pieces);
      joints.is_corner.push_back(k == 0 && has_corner);
    }
  }
  return joints;
}

BezierPlace place_of(double u, const std::vector<double> &joints)
{
  if (u < joints[0])
    u += 1;
  const auto after = std::upper_bound(joints.begin(), joints.end(), u);
  const std::size_t segment = static_cast<std::size_t>(after - joints.begin()) - 1;
  const double end = after == joints.end() ? joints[0] + 1 : *after;
  return {segment, (u - joints[segment]) / (end - joints[segment])};
}

std::vector<char> borders_of(const InitialOutline &outline, const std::vector<BezierPlace> &places,
                             const Eigen::VectorXd &share, std::size_t n_segments)
{
  std::vector<double> with(n_segments, 0), all(n_segments, 0);
  const Eigen::Index n = share.size();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double length = (i + 1 < n ? share[i + 1] : 1.0) - share[i];
    const std::size_t point = static_cast<std::size_t>(i);
    all[places[point].segment] += length;
    if (outline.has_border.empty() || outline.has_border[point])
      with[places[point].segment] += length;
  }
  std::vector<char> has_border(n_segments);
  for (std::size_t i = 0; i < n_segments; ++i)
    has_border[i] = !outline.flow_only && (all[i] == 0 || 2 * with[i] > all[i]);
  return has_border;
}
} // namespace

Eigen::Vector4d bernstein(double t)
{
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

Eigen::Vector2d BezierCurve::position(std::size_t segment, double t) const
{
  const Eigen::Vector4d b = bernstein(t);
  return b[0] * joints[segment] + b[1] * inner[segment][0] + b[2] * inner[segment][1] + b[3] * next_joint(segment);
}

Eigen::Vector2d BezierCurve::tangent(std::size_t segment, double t) const
{
  const double s = 1 - t;
  const Eigen::Vector2d derivative = s * s * (inner[segment][0] - joints[segment]) +
                                     2 * s * t * (inner[segment][1] - inner[segment][0]) +
                                     t * t * (next_joint(segment) - inner[segment][1]);
  if (derivative.norm() > 1e-9)
    return derivative.normalized();
  return (next_joint(segment) - joints[segment]).stableNormalized();
}

Eigen::Vector2d BezierCurve::normal(std::size_t segment, double t) const
{
  const Eigen::Vector2d along = tangent(segment, t);
  return {along.y(), -along.x()};
}

PixelPoints BezierFit::points_on(const BezierCurve &moved) const
{
  PixelPoints points(static_cast<Eigen::Index>(places.size()), 2);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const auto [segment, t] = places[i];
    points.row(static_cast<Eigen::Index>(i)) = moved.position(segment, t) +
                                               remainder[i].x() * moved.tangent(segment, t) +
                                               remainder[i].y() * moved.normal(segment, t);
  }
  return points;
}

BezierFit fit_bezier(const InitialOutline &outline, const Options &options)
{
  const ArcLength arc(outline.points);
  const bool is_reversed = signed_area(outline.points) < 0;
  Eigen::VectorXd u = arc.share;
  if (is_reversed)
    for (double &value : u)
      value = value > 0 ? 1 - value : 0;
  const ClosedSpline spline = spline_of(outline.points, arc.perimeter, is_reversed);
  const double u_a_pixel = 1 / arc.perimeter;
  const Joints joints = joints_of(corners_of(spline, options.corner_curvature, 0.5 * options.joint_spacing * u_a_pixel),
                                  options.joint_spacing * u_a_pixel);

  BezierFit fit;
  fit.is_corner = joints.is_corner;
  const std::size_t n = joints.u.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const double start = joints.u[i], end = i + 1 < n ? joints.u[i + 1] : joints.u[0] + 1;
    fit.curve.joints.push_back(spline.position(start));
    const double third = (end - start) / 3;
    fit.curve.inner.push_back({spline.position(start) + third * spline.first_derivative(start),
                               spline.position(end) - third * spline.first_derivative(end)});
  }
  for (Eigen::Index i = 0; i < outline.points.rows(); ++i)
  {
    const BezierPlace place = place_of(u[i], joints.u);
    fit.places.push_back(place);
    const Eigen::Vector2d rest = outline.points.row(i).transpose() - fit.curve.position(place.segment, place.t);
    fit.remainder.push_back(
        {rest.dot(fit.curve.tangent(place.segment, place.t)), rest.dot(fit.curve.normal(place.segment, place.t))});
  }
  fit.has_border = borders_of(outline, fit.places, arc.share, n);
  return fit;
}
} // namespace pelvireg::tracking
