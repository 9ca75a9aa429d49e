// The pelvic floor: a bowl between the hiatus and its bony edge (pubis, tendinous arcs, coccyx).
#include "synthetic/anatomy/organs.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;

namespace
{
constexpr double quarter = std::numbers::pi / 2; // turn of the edge over the bone

/// The left half, its first and last point on the midline, closed by its mirror image.
std::vector<Vector3d> mirrored(const std::vector<Vector3d> &left)
{
  std::vector<Vector3d> loop = left;
  for (std::size_t i = left.size() - 2; i > 0; --i)
    loop.push_back({-left[i][0], left[i][1], left[i][2]});
  return loop;
}
} // namespace

std::vector<Chart> floor_charts(const FloorShape &shape, double size)
{
  const std::vector<Vector3d> hiatus = mirrored(shape.hiatus), edge = mirrored(shape.edge);
  const double n = static_cast<double>(hiatus.size()), sag = shape.sag;
  const auto point = [=](double turn, double out) -> Vector3d
  {
    const Vector3d inner = closed_curve(hiatus, turn * n), outer = closed_curve(edge, turn * n);
    return (1 - out) * inner + out * outer - Vector3d(0, 0, 4 * sag * out * (1 - out));
  };
  double girth = 0, width = 0;
  const int samples = 200;
  for (int i = 0; i < samples; ++i)
  {
    const double turn = static_cast<double>(i) / samples;
    girth += (point(turn + 1.0 / samples, 0.5) - point(turn, 0.5)).norm();
    width += (point(turn, 1) - point(turn, 0)).norm() / samples;
  }
  Chart bowl;
  bowl.n_a = count(girth, size, 8);
  bowl.n_b = count(width, size, 2);
  bowl.evaluate = [=](double a, double b)
  {
    const Vector3d normal = normal_by_differences(point, a, b, 1e-6, 1e-6);
    return SurfacePoint{point(a, b), normal[2] < 0 ? Vector3d(-normal) : normal};
  };
  // The abdominal pressure reaches the whole cranial face through the fat that lies between it and the peritoneum.
  carry_pressure(bowl, [](const SurfacePoint &) { return 1.; });
  if (shape.edge_radius == 0)
    return {bowl};

  Chart edge_over_bone;
  edge_over_bone.n_a = bowl.n_a;
  edge_over_bone.n_b = count(quarter * shape.edge_radius, size, 3);
  edge_over_bone.evaluate = [=, radius = shape.edge_radius](double a, double b)
  {
    const SurfacePoint start = bowl.evaluate(a, 1);
    const Vector3d along = (point(a + 1e-6, 1) - point(a - 1e-6, 1)).normalized();
    Vector3d outward = along.cross(start.normal);
    if (outward.dot(start.position - point(a, 0)) < 0)
      outward = -outward;
    const double turned = quarter * b;
    return SurfacePoint{start.position + radius * (std::sin(turned) * outward - (1 - std::cos(turned)) * start.normal),
                        std::cos(turned) * start.normal + std::sin(turned) * outward};
  };
  carry_pressure(edge_over_bone, [](const SurfacePoint &) { return 1.; });
  return {bowl, edge_over_bone};
}
} // namespace pelvireg::anatomy
