// The rectum: a circular tube along a curved axis with the anorectal angle; both ends open.
#include "synthetic/anatomy/organs.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;

std::vector<Chart> rectum_charts(const RectumShape &shape, double size)
{
  const Axis axis("rectum", shape.axis, shape.fillet_radii);
  std::vector<double> stations = shape.radius_stations;
  for (double &s : stations)
    s *= axis.length();
  const Profile radius(stations, shape.radii);
  const auto point = [=](double t, double angle) -> Vector3d
  {
    const Vector3d tangent = axis.tangent(t), across = (Vector3d::UnitX() - tangent[0] * tangent).normalized();
    return axis.point(t) + radius(t) * (std::cos(angle) * across + std::sin(angle) * tangent.cross(across));
  };
  double mean_radius = 0;
  for (const double r : shape.radii)
    mean_radius += r / static_cast<double>(shape.radii.size());

  Chart chart;
  chart.n_a = count(2 * std::numbers::pi * mean_radius, size, 6);
  chart.n_b = count(axis.length(), size, 3);
  const double length = axis.length();
  chart.evaluate = [=](double a, double b)
  {
    const auto map = [&](double angle, double t) { return point(t, angle); };
    return SurfacePoint{point(b * length, 2 * std::numbers::pi * a),
                        normal_by_differences(map, 2 * std::numbers::pi * a, b * length, 1e-5, 1e-4)};
  };
  // Peritoneum covers the front, and leaves the sides between 30 degrees before and behind them.
  carry_pressure(
      chart, [=](const SurfacePoint &p)
      { return fade_in(p.position[2], shape.peritoneal_above, shape.peritoneal_fade) * fade_in(-p.normal[1], 0, 1); });
  return {chart};
}
} // namespace pelvireg::anatomy
