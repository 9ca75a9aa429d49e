#include "synthetic/anatomy/organs.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;

namespace
{
/// A smooth bump on the unit sphere around `direction`: 1 there, exp(-1) at the angle `width` (for small widths).
double bump(const Vector3d &d, const Vector3d &direction, double width)
{
  return std::exp(-(2 - 2 * d.dot(direction)) / (width * width));
}

/// Unit sphere to bladder: ellipsoid, dome flattened, neck drawn out, uterus pressed in.
Vector3d bladder_point(const BladderShape &shape, const Vector3d &d)
{
  Vector3d p = shape.semi_axes.cwiseProduct(d);
  if (d[2] > 0)
    p[2] *= 1 - shape.dome_flattening * d[2] * d[2];
  const Vector3d neck = shape.neck_direction.normalized(), impression = shape.impression_direction.normalized();
  p += shape.neck_length * bump(d, neck, shape.neck_width) * neck;
  p -= shape.impression_depth * bump(d, impression, shape.impression_width) * impression;
  return shape.centre + p;
}

SurfacePoint bladder_surface(const BladderShape &shape, const Vector3d &d)
{
  const Vector3d u = d.unitOrthogonal(), v = d.cross(u);
  const auto map = [&](double s, double t) { return bladder_point(shape, (d + s * u + t * v).normalized()); };
  return {bladder_point(shape, d), normal_by_differences(map, 0, 0, 1e-5, 1e-5)};
}
} // namespace

int count(double length, double size, int least)
{
  return std::max(least, static_cast<int>(std::lround(length / size)));
}

std::vector<Chart> bladder_charts(const BladderShape &shape, double size)
{
  // Six faces of a cube blown up to the sphere, equal angles: a quarter of the mean girth a face.
  const double quarter_girth = std::numbers::pi / 2 * shape.semi_axes.mean();
  const int n = count(quarter_girth, size, 2);
  std::vector<Chart> charts;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
    {
      Chart chart;
      chart.n_a = chart.n_b = n;
      chart.evaluate = [=](double a, double b)
      {
        Vector3d d;
        d[axis] = sign;
        d[(axis + 1) % 3] = std::tan((a - 0.5) * std::numbers::pi / 2);
        d[(axis + 2) % 3] = std::tan((b - 0.5) * std::numbers::pi / 2);
        return bladder_surface(shape, d.normalized());
      };
      carry_pressure(chart, [=](const SurfacePoint &p)
                     { return fade_in(p.position[2], shape.peritoneal_above, shape.peritoneal_fade); });
      charts.push_back(chart);
    }
  return charts;
}
} // namespace pelvireg::anatomy
