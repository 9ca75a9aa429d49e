// The vagina: a ribbon of half-width f(t) along the axis, thickened by a ball of the half-depth. So every section is a
// stadium, the apex is rounded, and no outer radius is smaller than the half-depth (the wall never folds).
#include "synthetic/anatomy/organs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelvireg::anatomy
{
using dataset::SurfaceRegion;
using Eigen::Vector3d;
using std::numbers::pi;

namespace
{
/// A place around the tube: `ribbon` in [-1, 1] across the ribbon, `angle` of the section's normal (0: left, pi/2:
/// posterior), and the local angle on the face of the cube that closes the apex.
struct Around
{
  double ribbon, angle;
};

/// Faces 0 left, 1 posterior, 2 right, 3 anterior; `a` by arc length of the reference section.
Around around(int face, double a, double half_depth, double half_flat)
{
  const double side = face % 2 == 0 ? 1 : -1;
  if (face % 2 == 0)
    return {face == 0 ? 1.0 : -1.0, face * pi / 2 + (a - 0.5) * pi / 2};
  const double arc = half_depth * pi / 4, total = 2 * (arc + half_flat), s = a * total;
  const double sign = face == 1 ? 1 : -1; // posterior runs from left to right, anterior back
  if (s < arc)
    return {sign, face * pi / 2 - pi / 4 + s / half_depth};
  if (s > arc + 2 * half_flat)
    return {-sign, face * pi / 2 + (s - arc - 2 * half_flat) / half_depth};
  (void)side;
  return {sign * (1 - (s - arc) / half_flat), face * pi / 2};
}

class VaginaSurface
{
public:
  explicit VaginaSurface(const VaginaShape &shape)
      : axis_("vagina", shape.axis, shape.fillet_radii), depth_(shape.half_depth), end_(axis_.length() - depth_),
        flat_(profile(shape))
  {
    reference_flat_ = flat_(end_ / 2);
  }

  double end() const { return end_; } ///< arc length at which the rounded apex starts
  double depth() const { return depth_; }
  double reference_flat() const { return reference_flat_; }
  double cap_length() const { return depth_ * pi / 4; } ///< of a side face, up to the edge of the top face

  /// Tube at arc length t.
  SurfacePoint tube(double t, const Around &at) const
  {
    const Vector3d tangent = axis_.tangent(t), normal = section_normal(t, at.angle);
    const double h = 1e-5;
    const Vector3d slope = (tube_point(t + h, at) - tube_point(t - h, at)) / (2 * h);
    return {tube_point(t, at), (normal - slope.dot(normal) / slope.dot(tangent) * tangent).normalized()};
  }

  /// Rounded apex: direction (left, posterior, axial) of the ball at `ribbon`.
  SurfacePoint apex(const Vector3d &direction, double ribbon) const
  {
    const Vector3d tangent = axis_.tangent(end_);
    const Vector3d n = direction.normalized();
    const Vector3d normal = n[0] * Vector3d::UnitX() + n[1] * tangent.cross(Vector3d::UnitX()) + n[2] * tangent;
    return {axis_.point(end_) + ribbon * flat_(end_) * Vector3d::UnitX() + depth_ * normal, normal};
  }

private:
  static Profile profile(const VaginaShape &shape)
  {
    const double length = Axis("vagina", shape.axis, shape.fillet_radii).length() - shape.half_depth;
    std::vector<double> stations, half_flats;
    for (std::size_t i = 0; i < shape.widths.size(); ++i)
    {
      stations.push_back(shape.width_stations[i] * length);
      half_flats.push_back(shape.widths[i] / 2 - shape.half_depth);
    }
    return Profile(stations, half_flats);
  }

  // The axis lies in a sagittal plane: x is across.
  Vector3d section_normal(double t, double angle) const
  {
    return std::cos(angle) * Vector3d::UnitX() + std::sin(angle) * axis_.tangent(t).cross(Vector3d::UnitX());
  }

  Vector3d tube_point(double t, const Around &at) const
  {
    return axis_.point(t) + at.ribbon * flat_(t) * Vector3d::UnitX() + depth_ * section_normal(t, at.angle);
  }

  Axis axis_;
  double depth_, end_;
  Profile flat_;
  double reference_flat_ = 0;
};

/// One of the four sides, from the introitus up to the edge of the top face.
Chart side_chart(const VaginaSurface &surface, int face, int n_around, int n_along)
{
  Chart chart;
  chart.n_a = n_around;
  chart.n_b = n_along;
  const double total = surface.end() + surface.cap_length();
  chart.evaluate = [=](double a, double b)
  {
    const Around at = around(face, a, surface.depth(), surface.reference_flat());
    const double t = b * total;
    if (t <= surface.end())
      return surface.tube(t, at);
    const double local = at.angle - face * pi / 2, elevation = (t - surface.end()) / surface.depth();
    const double c = std::cos(face * pi / 2), s = std::sin(face * pi / 2), across = std::tan(local);
    return surface.apex({c - s * across, s + c * across, std::tan(elevation)}, at.ribbon);
  };
  return chart;
}

Chart top_chart(const VaginaSurface &surface, int n_across, int n_depth)
{
  Chart chart;
  chart.n_a = n_across;
  chart.n_b = n_depth;
  chart.evaluate = [=](double a, double b)
  {
    const Around at = around(1, a, surface.depth(), surface.reference_flat());
    return surface.apex({-std::tan(at.angle - pi / 2), std::tan((b - 0.5) * pi / 2), 1}, at.ribbon);
  };
  return chart;
}
} // namespace

std::vector<Chart> vagina_charts(const VaginaShape &vagina, const UterusShape &uterus, double size)
{
  const VaginaSurface surface(vagina);
  const int n_depth = count(surface.depth() * pi / 2, size),
            n_along = count(surface.end() + surface.cap_length(), size, 2);
  const int n_across = count(2 * surface.reference_flat() + surface.depth() * pi / 2, size, 2);
  std::vector<Chart> charts;
  for (int face = 0; face < 4; ++face)
    charts.push_back(side_chart(surface, face, face % 2 == 0 ? n_depth : n_across, n_along));
  charts.push_back(top_chart(surface, n_across, n_depth));
  const CervixPatch patch = cervix_patch(uterus, vagina);
  for (Chart &chart : charts)
    chart.region = [patch](const SurfacePoint &p)
    { return patch.contains(p.position) ? SurfaceRegion::cervix_patch : SurfaceRegion::wall; };
  return charts;
}
} // namespace pelvireg::anatomy
