#include "synthetic/anatomy/bar_ends.h"

#include "synthetic/anatomy/nearest_point.h"

#include <Eigen/Geometry>

#include <limits>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace
{
constexpr double least_weight = 1e-6;

/// Ring of a VTK_BIQUADRATIC_QUAD, whose last node is its centre.
constexpr int quad_ring[8] = {0, 4, 1, 5, 2, 6, 3, 7};
/// Quarters of a VTK_QUADRATIC_TRIANGLE.
constexpr int triangle_quarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};

Vector3d barycentric(const Vector3d &p, const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const auto weight = [&](const Vector3d &from, const Vector3d &to)
  { return (to - from).cross(p - from).dot(normal) / normal.squaredNorm(); };
  return {weight(b, c), weight(c, a), weight(a, b)};
}
} // namespace

BarSurface::BarSurface(const dataset::ReferenceModel &model, const std::string &part)
{
  for (const dataset::ReferenceShell &shell : model.shells)
    if (shell.name == part)
    {
      points_ = shell.midsurface;
      for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
        for (int k = 0; k < 8; ++k)
          triangles_.emplace_back(shell.cells(c, quad_ring[k]), shell.cells(c, quad_ring[(k + 1) % 8]),
                                  shell.cells(c, 8));
    }
  for (const dataset::ReferenceSolid &solid : model.solids)
    if (solid.name == part)
    {
      points_ = solid.points;
      for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
        for (const auto &quarter : triangle_quarters)
          triangles_.emplace_back(solid.faces(f, quarter[0]), solid.faces(f, quarter[1]), solid.faces(f, quarter[2]));
    }
}

BarEnd BarSurface::closest(const Vector3d &point) const
{
  BarEnd end;
  const Vector3i *best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3i &triangle : triangles_)
  {
    const Vector3d nearest = nearest_on_triangle(point, node(triangle[0]), node(triangle[1]), node(triangle[2]));
    if (const double distance = (nearest - point).squaredNorm(); distance < least)
    {
      least = distance;
      end.position = nearest;
      best = &triangle;
    }
  }
  const Vector3d weights = barycentric(end.position, node((*best)[0]), node((*best)[1]), node((*best)[2]));
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    if (weights[k] > least_weight)
    {
      end.nodes.emplace_back((*best)[k], weights[k]);
      sum += weights[k];
    }
  for (auto &[index, weight] : end.nodes)
    weight /= sum;
  return end;
}
} // namespace pelvireg::anatomy
