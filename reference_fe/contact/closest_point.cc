#include "reference_fe/contact/closest_point.h"

#include <Eigen/Geometry>

namespace pelvireg::reference_fe
{
namespace
{
Eigen::Vector3d closest_barycentric(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                                    const Eigen::Vector3d &c)
{
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0)
    return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3)
    return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6)
    return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
    return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
    return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
  {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {1 - vb / sum - vc / sum, vb / sum, vc / sum};
}
} // namespace

ClosestPoint closest_point(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                           const Eigen::Vector3d &c)
{
  const Eigen::Vector3d l = closest_barycentric(p, a, b, c);
  return {(l[0] * a + l[1] * b + l[2] * c - p).norm(), l};
}

const std::vector<std::array<int, 3>> &face_facets(int n_nodes)
{
  using Facet = std::array<int, 3>;
  static const std::vector<Facet> quadrilateral = {Facet{8, 0, 4}, Facet{8, 4, 1}, Facet{8, 1, 5}, Facet{8, 5, 2},
                                                   Facet{8, 2, 6}, Facet{8, 6, 3}, Facet{8, 3, 7}, Facet{8, 7, 0}};
  static const std::vector<Facet> triangle = {Facet{0, 3, 5}, Facet{3, 1, 4}, Facet{5, 4, 2}, Facet{3, 4, 5}};
  return n_nodes == 9 ? quadrilateral : triangle;
}

Eigen::Vector2d face_node_coordinates(int n_nodes, int node)
{
  static const double quadrilateral[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  static const double triangle[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const auto &at = n_nodes == 9 ? quadrilateral[node] : triangle[node];
  return {at[0], at[1]};
}
} // namespace pelvireg::reference_fe
