#include "validation/metrics/penetration.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

namespace pelvireg::metrics
{
namespace
{
std::vector<Eigen::Vector3d> probes_of(const dataset::Points &points, const dataset::Triangles &triangles,
                                       const dataset::Integers &region)
{
  std::vector<char> is_scored_node(static_cast<std::size_t>(points.rows()), 0);
  std::vector<Eigen::Vector3d> probes;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    if (!is_scored(region[t]))
      continue;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      is_scored_node[static_cast<std::size_t>(triangles(t, k))] = 1;
      centroid += points.row(triangles(t, k)).transpose() / 3;
    }
    probes.push_back(centroid);
  }
  for (Eigen::Index node = 0; node < points.rows(); ++node)
    if (is_scored_node[static_cast<std::size_t>(node)])
      probes.push_back(points.row(node).transpose());
  return probes;
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

ProbedSurface::ProbedSurface(const dataset::Points &points, const dataset::Triangles &triangles,
                             const dataset::Integers &region)
    : tree_(points, triangles, region), inside_(points, triangles), probes_(probes_of(points, triangles, region)),
      lower_(points.colwise().minCoeff().transpose()), upper_(points.colwise().maxCoeff().transpose())
{
}

void ProbedSurface::probe(const ProbedSurface &other, Penetration &result) const
{
  for (const Eigen::Vector3d &p : probes_)
  {
    if ((p.array() < other.lower_.array()).any() || (p.array() > other.upper_.array()).any() ||
        !other.inside_.is_inside(p))
      continue;
    ++result.n_inside;
    if (const double depth = other.tree_.distance(p); !(depth <= result.depth))
    {
      result.depth = depth;
      result.at = p;
    }
  }
}

Penetration penetration(const ProbedSurface &a, const ProbedSurface &b)
{
  Penetration result;
  a.probe(b, result);
  b.probe(a, result);
  return result;
}

Penetration penetration(const dataset::SurfaceMesh &a, const dataset::SurfaceMesh &b)
{
  return penetration(ProbedSurface(a.points, a.triangles, a.region), ProbedSurface(b.points, b.triangles, b.region));
}
} // namespace pelvireg::metrics
