#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pelvireg::registration::scene
{
namespace
{
using Surface = std::pair<std::vector<Eigen::Vector3d>, std::vector<std::array<int, 3>>>;

Surface icosphere(int n_subdivisions)
{
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < n_subdivisions; ++level)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new)
        points.push_back(0.5 * (points[a] + points[b]));
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto &[a, b, c] : faces)
    {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
  }
  for (Eigen::Vector3d &point : points)
    point.normalize();
  return {points, faces};
}

/// Kuhn split of a VTK-ordered hexahedron along its diagonal 0-6: neighbours in a grid share their faces' diagonals.
constexpr int kuhn[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};

void orient(Body &body)
{
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
  {
    const auto corner = [&](int a) -> Eigen::RowVector3d { return body.rest_positions.row(body.tets(t, a)); };
    if ((corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) < 0)
      std::swap(body.tets(t, 2), body.tets(t, 3));
  }
}

void set_boundary(Body &body)
{
  std::map<std::array<int, 3>, std::array<int, 3>> open;
  constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
    for (const auto &face : faces)
    {
      const std::array<int, 3> oriented{body.tets(t, face[0]), body.tets(t, face[1]), body.tets(t, face[2])};
      std::array<int, 3> key = oriented;
      std::sort(key.begin(), key.end());
      if (!open.erase(key))
        open[key] = oriented;
    }
  body.outer_triangles.resize(static_cast<Eigen::Index>(open.size()), 3);
  Eigen::Index row = 0;
  for (const auto &[key, oriented] : open)
    body.outer_triangles.row(row++) << oriented[0], oriented[1], oriented[2];
  body.is_wall.assign(open.size(), 1);
}
} // namespace

Body hollow_ellipsoid(const Eigen::Vector3d &half_axes, double wall, int n_subdivisions, const Eigen::Vector3d &centre)
{
  const auto [points, faces] = icosphere(n_subdivisions);
  const int n = static_cast<int>(points.size());
  Body body;
  body.name = "ellipsoid";
  body.youngs_modulus = 0.5;
  body.rest_positions.resize(2 * n, 3);
  const Eigen::Vector3d inner = half_axes.array() - wall;
  for (int i = 0; i < n; ++i)
  {
    body.rest_positions.row(i) = (centre + half_axes.cwiseProduct(points[i])).transpose();
    body.rest_positions.row(n + i) = (centre + inner.cwiseProduct(points[i])).transpose();
  }
  body.tets.resize(3 * static_cast<Eigen::Index>(faces.size()), 4);
  body.outer_triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  Eigen::Index tet = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    body.outer_triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    std::array<int, 3> v = faces[f]; // prism split by ascending corner: neighbours agree on the shared diagonals
    std::sort(v.begin(), v.end());
    body.tets.row(tet) << v[0], v[1], v[2], n + v[2];
    body.tets.row(tet + 1) << v[0], v[1], n + v[1], n + v[2];
    body.tets.row(tet + 2) << v[0], n + v[0], n + v[1], n + v[2];
    tet += 3;
  }
  body.is_wall.assign(faces.size(), 1);
  orient(body);
  return body;
}

Body block(const Eigen::Vector3d &size, const Eigen::Vector3i &n, bool tetrahedral, bool with_surface,
           const Eigen::Vector3d &origin)
{
  Body body;
  body.name = "block";
  body.youngs_modulus = 0.5;
  const auto index = [&](int i, int j, int k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  body.rest_positions.resize((n[0] + 1) * (n[1] + 1) * (n[2] + 1), 3);
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
        body.rest_positions.row(index(i, j, k)) =
            (origin + size.cwiseProduct(Eigen::Vector3d(i, j, k)).cwiseQuotient(n.cast<double>())).transpose();
  Hexes hexes(n.prod(), 8);
  Eigen::Index cell = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        hexes.row(cell++) << index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k), index(i, j + 1, k),
            index(i, j, k + 1), index(i + 1, j, k + 1), index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1);
  if (!tetrahedral)
  {
    body.hexes = hexes;
    return body;
  }
  body.tets.resize(6 * hexes.rows(), 4);
  for (Eigen::Index h = 0; h < hexes.rows(); ++h)
    for (int t = 0; t < 6; ++t)
      for (int a = 0; a < 4; ++a)
        body.tets(6 * h + t, a) = hexes(h, kuhn[t][a]);
  if (with_surface)
    set_boundary(body);
  return body;
}

OutlineObservation outline(const Body &body, int index, const Points &positions, const Eigen::Vector3d &plane_origin,
                           const Eigen::Vector3d &plane_normal, int stride)
{
  std::vector<Eigen::Vector3d> points, normals;
  int n_cut = 0;
  for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
  {
    std::array<Eigen::Vector3d, 3> corner;
    std::array<double, 3> side;
    for (int i = 0; i < 3; ++i)
    {
      corner[i] = positions.row(body.outer_triangles(t, i)).transpose();
      side[i] = (corner[i] - plane_origin).dot(plane_normal);
    }
    std::vector<Eigen::Vector3d> ends;
    for (int i = 0; i < 3; ++i)
      if (const int j = (i + 1) % 3; (side[i] < 0) != (side[j] < 0))
        ends.push_back(corner[i] + side[i] / (side[i] - side[j]) * (corner[j] - corner[i]));
    if (ends.size() != 2 || n_cut++ % stride != 0)
      continue;
    Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    normal -= normal.dot(plane_normal) * plane_normal;
    points.push_back(0.5 * (ends[0] + ends[1]));
    normals.push_back(normal.normalized());
  }
  OutlineObservation result;
  result.body = index;
  result.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  result.normals.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    result.points.row(static_cast<Eigen::Index>(k)) = points[k].transpose();
    result.normals.row(static_cast<Eigen::Index>(k)) = normals[k].transpose();
  }
  return result;
}
} // namespace pelvireg::registration::scene
