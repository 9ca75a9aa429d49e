// The uterus: elliptic sections along a flexed axis, rounded at the fundus. Its caudal end is cut by the plane of the
// vagina's straight anterior wall: the end face is the shared patch itself.
#include "synthetic/anatomy/organs.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pelvireg::anatomy
{
using dataset::SurfaceRegion;
using Eigen::Vector3d;
using std::numbers::pi;

namespace
{
/// Centre and normal of the patch on the vagina's anterior wall.
std::pair<Vector3d, Vector3d> patch_on_wall(const UterusShape &uterus, const VaginaShape &vagina)
{
  const Axis axis("vagina", vagina.axis, vagina.fillet_radii);
  const double station = axis.length() - uterus.patch_distance;
  const Vector3d tangent = axis.tangent(station), anterior = Vector3d::UnitX().cross(tangent);
  return {axis.point(station) + vagina.half_depth * anterior, anterior};
}

class UterusSurface
{
public:
  UterusSurface(const UterusShape &shape, const CervixPatch &patch)
      : patch_(patch), sleeve_(shape.cervix_sleeve), fundus_length_(shape.fundus_length),
        axis_("uterus",
              {patch.centre, deviated(shape.internal_os, patch.centre, shape.deviation),
               deviated(shape.fundus, patch.centre, shape.deviation)},
              {shape.fillet_radius}),
        end_(axis_.length() - fundus_length_), half_width_(scaled(shape.stations, end_), shape.half_widths),
        half_depth_(scaled(shape.stations, end_), shape.half_depths)
  {
  }

  double end() const { return end_; }
  double mean_girth() const { return 2 * pi * (half_width_(0.7 * end_) + half_depth_(0.7 * end_)) / 2; }
  double cap_length() const { return (half_width_(end_) + half_depth_(end_)) / 2 * pi / 4; }

  /// Lateral surface at arc length t and angle (0: left, pi/2: posterior).
  Vector3d lateral(double t, double angle) const
  {
    const Vector3d offset = section_offset(t, angle);
    if (t >= sleeve_)
      return axis_.point(t) + offset;
    // Straight part: the axial position runs from the patch's plane (t = 0) to the plane section (t = sleeve).
    const double on_plane = -offset.dot(patch_.normal) / patch_.axis.dot(patch_.normal);
    return patch_.centre + offset + (on_plane + t / sleeve_ * (sleeve_ - on_plane)) * patch_.axis;
  }

  /// Rounded fundus in the direction (left, posterior, axial).
  Vector3d fundus(const Vector3d &direction) const
  {
    const Vector3d d = direction.normalized(), tangent = axis_.tangent(end_);
    const Vector3d across = across_axis(tangent);
    return axis_.point(end_) + half_width_(end_) * d[0] * across + half_depth_(end_) * d[1] * tangent.cross(across) +
           fundus_length_ * d[2] * tangent;
  }

  Vector3d on_patch(double radius_fraction, double angle) const
  {
    return patch_.centre + radius_fraction * (lateral(0, angle) - patch_.centre);
  }

private:
  static std::vector<double> scaled(std::vector<double> stations, double length)
  {
    for (double &s : stations)
      s *= length;
    return stations;
  }

  // The axis stays in the deviated sagittal plane, whose normal is `across`.
  Vector3d across_axis(const Vector3d &tangent) const
  {
    return (Vector3d::UnitX() - tangent[0] * tangent).normalized();
  }

  Vector3d section_offset(double t, double angle) const
  {
    const Vector3d tangent = axis_.tangent(t), across = across_axis(tangent);
    return half_width_(t) * std::cos(angle) * across + half_depth_(t) * std::sin(angle) * tangent.cross(across);
  }

  CervixPatch patch_;
  double sleeve_, fundus_length_;
  Axis axis_;
  double end_;
  Profile half_width_, half_depth_;
};

/// Only positions of the uterus are used (it is solid); the chart's normal comes from differences.
Chart chart_of(std::function<Vector3d(double, double)> map, const Vector3d &inside, int n_a, int n_b)
{
  Chart chart;
  chart.n_a = n_a;
  chart.n_b = n_b;
  chart.evaluate = [map, inside](double a, double b)
  {
    const Vector3d position = map(a, b), normal = normal_by_differences(map, a, b, 1e-6, 1e-6);
    return SurfacePoint{position, normal.dot(position - inside) > 0 ? normal : Vector3d(-normal)};
  };
  return chart;
}

Chart lateral_chart(const UterusSurface &surface, int face, int n_around, int n_along)
{
  const double total = surface.end() + surface.cap_length();
  const auto map = [=](double a, double b) -> Vector3d
  {
    const double local = (a - 0.5) * pi / 2, t = b * total;
    if (t <= surface.end())
      return surface.lateral(t, face * pi / 2 + local);
    const double elevation = (t - surface.end()) / surface.cap_length() * pi / 4;
    const double c = std::cos(face * pi / 2), s = std::sin(face * pi / 2), across = std::tan(local);
    return surface.fundus({c - s * across, s + c * across, std::tan(elevation)});
  };
  Chart chart;
  chart.n_a = n_around;
  chart.n_b = n_along;
  chart.evaluate = [map](double a, double b) {
    return SurfacePoint{map(a, b), normal_by_differences(map, a, b, 1e-6, 1e-6)};
  };
  return chart;
}

/// The patch: a square core and four sectors out to its rim.
std::vector<Chart> patch_charts(const UterusSurface &surface, const Vector3d &outward, int n_around, int n_out)
{
  const double core = 0.5;
  // A square with sides bulged half-way to the circle: no flat angle at its corners.
  const auto core_point = [=](double u, double v) -> Vector3d
  {
    const double r = core * std::max(std::abs(u), std::abs(v)), along = std::hypot(u, v);
    if (along == 0)
      return surface.on_patch(0, 0);
    const double square = core * along, circle = r * 1.2;
    return surface.on_patch((square + circle) / 2, std::atan2(v, u));
  };
  std::vector<Chart> charts;
  charts.push_back(chart_of([=](double a, double b)
                            { return core_point(std::tan((a - 0.5) * pi / 2), std::tan((b - 0.5) * pi / 2)); },
                            Vector3d::Zero(), n_around, n_around));
  for (int face = 0; face < 4; ++face)
    charts.push_back(chart_of(
        [=](double a, double b) -> Vector3d
        {
          const double local = (a - 0.5) * pi / 2, c = std::cos(face * pi / 2), s = std::sin(face * pi / 2);
          const double across = std::tan(local);
          return (1 - b) * core_point(c - s * across, s + c * across) + b * surface.on_patch(1, face * pi / 2 + local);
        },
        Vector3d::Zero(), n_around, n_out));
  for (Chart &chart : charts)
  {
    const auto position = chart.evaluate;
    chart.evaluate = [=](double a, double b) { return SurfacePoint{position(a, b).position, outward}; };
    chart.region = [](const SurfacePoint &) { return SurfaceRegion::cervix_patch; };
  }
  return charts;
}
} // namespace

Vector3d deviated(const Vector3d &point, const Vector3d &centre, double degrees)
{
  return centre + Eigen::AngleAxisd(degrees * pi / 180, Vector3d::UnitY()) * (point - centre);
}

bool CervixPatch::contains(const Vector3d &point) const
{
  const Vector3d d = point - centre;
  return std::abs(d.dot(normal)) < 0.5 && (d - d.dot(axis) * axis).norm() <= radius;
}

CervixPatch cervix_patch(const UterusShape &uterus, const VaginaShape &vagina)
{
  const auto [centre, normal] = patch_on_wall(uterus, vagina);
  const Vector3d axis = (deviated(uterus.internal_os, centre, uterus.deviation) - centre).normalized();
  return {centre, normal, axis, uterus.half_widths.front()};
}

std::vector<Chart> uterus_charts(const UterusShape &uterus, const VaginaShape &vagina, double size)
{
  const CervixPatch patch = cervix_patch(uterus, vagina);
  const UterusSurface surface(uterus, patch);
  const int n_around = count(surface.mean_girth() / 4, size, 2);
  const int n_along = count(surface.end() + surface.cap_length(), size, 3);
  std::vector<Chart> charts;
  for (int face = 0; face < 4; ++face)
    charts.push_back(lateral_chart(surface, face, n_around, n_along));
  const auto top = [=](double a, double b) {
    return surface.fundus({std::tan((a - 0.5) * pi / 2), std::tan((b - 0.5) * pi / 2), 1});
  };
  charts.push_back(chart_of(top, patch.centre, n_around, n_around));
  const Vector3d os = deviated(uterus.internal_os, patch.centre, uterus.deviation);
  const Vector3d body = (deviated(uterus.fundus, patch.centre, uterus.deviation) - os).normalized();
  const double from = uterus.peritoneal_from, fade = uterus.peritoneal_fade;
  for (Chart &chart : charts)
    carry_pressure(chart, [=](const SurfacePoint &p) { return fade_in((p.position - os).dot(body), from, fade); });
  for (const Chart &chart : patch_charts(surface, -patch.normal, n_around, count(patch.radius / 2, size)))
    charts.push_back(chart);
  return charts;
}
} // namespace pelvireg::anatomy
