// Small parts for the tests of the terms: a cube as closed shell, a block of tetrahedra.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace pelvireg::reference_fe
{
/// The surface of the cube [-1, 1]^3, n x n cells of 9 nodes a side, moved by `map`; directors are `normal` of the
/// moved points. `open_top`: the side z = 1 is left out and its border listed as rim.
inline dataset::ReferenceShell cube_shell(int n, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &map,
                                          const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &normal,
                                          double thickness, bool open_top = false)
{
  std::map<std::tuple<int, int, int>, int> numbers;
  std::vector<Eigen::Vector3d> corners;
  const auto node = [&](const Eigen::Vector3i &at)
  {
    const auto [entry, is_new] = numbers.try_emplace({at[0], at[1], at[2]}, static_cast<int>(corners.size()));
    if (is_new)
      corners.push_back(at.cast<double>() / n);
    return entry->second;
  };
  std::vector<std::array<int, 9>> cells;
  static constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (int i = 0; i < n && !(open_top && axis == 2 && side == 1); ++i)
        for (int j = 0; j < n; ++j)
        {
          std::array<int, 9> cell;
          for (int k = 0; k < 9; ++k)
          {
            Eigen::Vector3i at;
            at[axis] = side * n;
            const int u = 2 * i + column[k] - n, v = 2 * j + row[k] - n;
            at[(axis + 1) % 3] = side > 0 ? u : v;
            at[(axis + 2) % 3] = side > 0 ? v : u;
            cell[k] = node(at);
          }
          cells.push_back(cell);
        }
  dataset::ReferenceShell shell;
  shell.name = "cube";
  shell.material = "wall";
  const Eigen::Index n_nodes = static_cast<Eigen::Index>(corners.size());
  shell.midsurface.resize(n_nodes, 3);
  shell.directors.resize(n_nodes, 3);
  shell.thickness = Eigen::VectorXd::Constant(n_nodes, thickness);
  for (Eigen::Index p = 0; p < n_nodes; ++p)
  {
    shell.midsurface.row(p) = map(corners[p]).transpose();
    shell.directors.row(p) = normal(corners[p]).transpose();
  }
  shell.cells.resize(static_cast<Eigen::Index>(cells.size()), 9);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int k = 0; k < 9; ++k)
      shell.cells(static_cast<Eigen::Index>(c), k) = cells[c][k];
  shell.region = dataset::Integers::Zero(shell.cells.rows());
  if (open_top)
  {
    std::vector<std::int32_t> loop;
    const auto walk = [&](Eigen::Vector3i at, const Eigen::Vector3i &step)
    {
      for (int i = 0; i < 2 * n; ++i, at += step)
        loop.push_back(node(at));
    };
    walk({-n, -n, n}, {1, 0, 0});
    walk({n, -n, n}, {0, 1, 0});
    walk({n, n, n}, {-1, 0, 0});
    walk({-n, n, n}, {0, -1, 0});
    shell.rims.push_back(Eigen::Map<dataset::Integers>(loop.data(), static_cast<Eigen::Index>(loop.size())));
  }
  return shell;
}

/// Closed sphere of mid-surface radius r.
inline dataset::ReferenceShell sphere_shell(int n, double radius, double thickness)
{
  const auto direction = [](const Eigen::Vector3d &p)
  {
    // Equal angles: tan(pi/4 t) spreads the cells evenly.
    return Eigen::Vector3d((p.array() * std::atan(1.)).tan().matrix().normalized());
  };
  return cube_shell(
      n, [=](const Eigen::Vector3d &p) { return Eigen::Vector3d(radius * direction(p)); }, direction, thickness);
}

/// Quadratic tetrahedra filling n[0] x n[1] x n[2] bricks of the box [0, size]^3, six a brick (Kuhn); boundary faces
/// outward.
inline dataset::ReferenceSolid block_solid(const Eigen::Vector3i &n, const Eigen::Vector3d &size)
{
  dataset::ReferenceSolid solid;
  solid.name = "block";
  solid.material = "wall";
  const Eigen::Vector3i m = 2 * n + Eigen::Vector3i::Ones();
  const auto node = [m](const Eigen::Vector3i &at) { return (at[0] * m[1] + at[1]) * m[2] + at[2]; };
  solid.points.resize(m.prod(), 3);
  for (int i = 0; i < m[0]; ++i)
    for (int j = 0; j < m[1]; ++j)
      for (int k = 0; k < m[2]; ++k)
        solid.points.row(node({i, j, k})) =
            (Eigen::Array3d(i, j, k) / (2. * n.cast<double>()).array() * size.array()).transpose();
  static constexpr int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  static constexpr int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::vector<std::array<int, 10>> cells;
  std::map<std::array<int, 3>, std::array<int, 6>> faces;
  for (int c = 0; c < n.prod(); ++c)
  {
    const Eigen::Vector3i base(2 * (c / (n[1] * n[2])), 2 * (c / n[2] % n[1]), 2 * (c % n[2]));
    std::array<int, 3> order = {{0, 1, 2}};
    do
    {
      std::array<Eigen::Vector3i, 4> corner = {{base, base, base, base}};
      for (int s = 0; s < 3; ++s)
        for (int t = s; t < 3; ++t)
          corner[t + 1][order[s]] += 2;
      Eigen::Matrix3d edges;
      for (int s = 0; s < 3; ++s)
        edges.col(s) = (corner[s + 1] - corner[0]).cast<double>();
      if (edges.col(0).cross(edges.col(1)).dot(edges.col(2)) < 0)
        std::swap(corner[2], corner[3]);
      std::array<int, 10> cell;
      for (int k = 0; k < 4; ++k)
        cell[k] = node(corner[k]);
      for (int e = 0; e < 6; ++e)
        cell[4 + e] = node((corner[edge[e][0]] + corner[edge[e][1]]) / 2);
      cells.push_back(cell);
      for (const auto &f : face)
      {
        std::array<int, 6> nodes;
        for (int k = 0; k < 3; ++k)
        {
          nodes[k] = cell[f[k]];
          nodes[3 + k] = node((corner[f[k]] + corner[f[(k + 1) % 3]]) / 2);
        }
        std::array<int, 3> key = {{nodes[0], nodes[1], nodes[2]}};
        std::sort(key.begin(), key.end());
        if (const auto [entry, is_new] = faces.try_emplace(key, nodes); !is_new)
          faces.erase(entry);
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
  solid.cells.resize(static_cast<Eigen::Index>(cells.size()), 10);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int k = 0; k < 10; ++k)
      solid.cells(static_cast<Eigen::Index>(c), k) = cells[c][k];
  solid.faces.resize(static_cast<Eigen::Index>(faces.size()), 6);
  Eigen::Index f = 0;
  for (const auto &[key, nodes] : faces)
  {
    for (int k = 0; k < 6; ++k)
      solid.faces(f, k) = nodes[k];
    ++f;
  }
  solid.region = dataset::Integers::Zero(solid.faces.rows());
  return solid;
}

inline dataset::ReferenceSolid block_solid(int n, const Eigen::Vector3d &size)
{
  return block_solid(Eigen::Vector3i(n, n, n), size);
}
} // namespace pelvireg::reference_fe
