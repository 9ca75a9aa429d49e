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
/// posterior).
struct Around
{
  double ribbon, angle;
};

/// Cells around one face of the tube and along it. Cells end where the section turns from flat to round and where the
/// axis turns from bent to straight, so that the patch of the cervix lies on whole plane cells.
struct Counts
{
  int depth;     ///< 90 degrees of the round sides
  int arc, flat; ///< 45 degrees and the flat of the anterior and posterior faces
  int bent, straight, cap;

  int across() const { return 2 * arc + flat; }
  int along() const { return bent + straight + cap; }
};

/// Faces 0 left, 1 posterior, 2 right, 3 anterior.
Around around(int face, double a, const Counts &counts)
{
  if (face % 2 == 0)
    return {face == 0 ? 1.0 : -1.0, face * pi / 2 + (a - 0.5) * pi / 2};
  const double sign = face == 1 ? 1 : -1; // posterior runs from left to right, anterior back
  const double column = a * counts.across();
  if (column < counts.arc)
    return {sign, face * pi / 2 - (1 - column / counts.arc) * pi / 4};
  if (column > counts.arc + counts.flat)
    return {-sign, face * pi / 2 + (column - counts.arc - counts.flat) / counts.arc * pi / 4};
  return {sign * (1 - 2 * (column - counts.arc) / counts.flat), face * pi / 2};
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
  Counts counts(double size, double aspect) const
  {
    Counts n;
    n.depth = count(depth_ * pi / 2, size);
    n.arc = count(depth_ * pi / 4, size);
    n.flat = count(2 * reference_flat_, size, 2);
    n.bent = count(axis_.last_straight_start(), size * aspect);
    n.straight = count(end_ - axis_.last_straight_start(), size * aspect, 2);
    n.cap = count(depth_ * pi / 4, size);
    return n;
  }

  /// Of a side face: arc length at `b` in [0, 1]; beyond end() it goes on up the rounded apex to the top face.
  double arc_length(double b, const Counts &n) const
  {
    const double row = b * n.along(), start = axis_.last_straight_start();
    if (row <= n.bent)
      return row / n.bent * start;
    if (row <= n.bent + n.straight)
      return start + (row - n.bent) / n.straight * (end_ - start);
    return end_ + (row - n.bent - n.straight) / n.cap * depth_ * pi / 4;
  }

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
Chart side_chart(const VaginaSurface &surface, int face, const Counts &counts)
{
  Chart chart;
  chart.n_a = face % 2 == 0 ? counts.depth : counts.across();
  chart.n_b = counts.along();
  chart.evaluate = [=](double a, double b)
  {
    const Around at = around(face, a, counts);
    const double t = surface.arc_length(b, counts);
    if (t <= surface.end())
      return surface.tube(t, at);
    const double local = at.angle - face * pi / 2, elevation = (t - surface.end()) / surface.depth();
    const double c = std::cos(face * pi / 2), s = std::sin(face * pi / 2), across = std::tan(local);
    return surface.apex({c - s * across, s + c * across, std::tan(elevation)}, at.ribbon);
  };
  return chart;
}

Chart top_chart(const VaginaSurface &surface, const Counts &counts)
{
  Chart chart;
  chart.n_a = counts.across();
  chart.n_b = counts.depth;
  chart.evaluate = [=](double a, double b)
  {
    const Around at = around(1, a, counts);
    return surface.apex({-std::tan(at.angle - pi / 2), std::tan((b - 0.5) * pi / 2), 1}, at.ribbon);
  };
  return chart;
}
} // namespace

std::vector<Chart> vagina_charts(const VaginaShape &vagina, const UterusShape &uterus, double size, double aspect)
{
  const VaginaSurface surface(vagina);
  const Counts counts = surface.counts(size, aspect);
  std::vector<Chart> charts;
  for (int face = 0; face < 4; ++face)
    charts.push_back(side_chart(surface, face, counts));
  charts.push_back(top_chart(surface, counts));
  const CervixPatch patch = cervix_patch(uterus, vagina);
  for (Chart &chart : charts)
    chart.region = [patch](const SurfacePoint &p)
    { return patch.contains(p.position) ? SurfaceRegion::cervix_patch : SurfaceRegion::wall; };
  return charts;
}
} // namespace pelvireg::anatomy
