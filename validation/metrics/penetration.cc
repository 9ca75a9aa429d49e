#include "validation/metrics/penetration.h"

#include "validation/metrics/surface_distance.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

namespace pelvireg::metrics
{
namespace
{
std::vector<Eigen::Vector3d> probes_of(const dataset::SurfaceMesh &surface)
{
  std::vector<char> is_scored_node(static_cast<std::size_t>(surface.points.rows()), 0);
  std::vector<Eigen::Vector3d> probes;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    if (!is_scored(surface.region[t]))
      continue;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      is_scored_node[static_cast<std::size_t>(surface.triangles(t, k))] = 1;
      centroid += surface.points.row(surface.triangles(t, k)).transpose() / 3;
    }
    probes.push_back(centroid);
  }
  for (Eigen::Index node = 0; node < surface.points.rows(); ++node)
    if (is_scored_node[static_cast<std::size_t>(node)])
      probes.push_back(surface.points.row(node).transpose());
  return probes;
}

void probe(const std::vector<Eigen::Vector3d> &probes, const dataset::SurfaceMesh &other, Penetration &result)
{
  const SurfaceTree tree(other.points, other.triangles, other.region);
  const Eigen::AlignedBox3d box(other.points.colwise().minCoeff().transpose(),
                                other.points.colwise().maxCoeff().transpose());
  for (const Eigen::Vector3d &p : probes)
  {
    if (!box.contains(p) || !is_inside(p, other.points, other.triangles))
      continue;
    ++result.n_inside;
    if (const double depth = tree.distance(p); !(depth <= result.depth))
    {
      result.depth = depth;
      result.at = p;
    }
  }
}
} // namespace

bool is_inside(const Eigen::Vector3d &p, const dataset::Points &points, const dataset::Triangles &triangles)
{
  double solid_angle = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    const Eigen::Vector3d a = points.row(triangles(t, 0)).transpose() - p,
                          b = points.row(triangles(t, 1)).transpose() - p,
                          c = points.row(triangles(t, 2)).transpose() - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle > 2 * std::numbers::pi;
}

Penetration penetration(const dataset::SurfaceMesh &a, const dataset::SurfaceMesh &b)
{
  for (const dataset::SurfaceMesh *surface : {&a, &b})
    require_usable_surface(surface->points, surface->triangles, surface->region);
  Penetration result;
  probe(probes_of(a), b, result);
  probe(probes_of(b), a, result);
  return result;
}
} // namespace pelvireg::metrics
