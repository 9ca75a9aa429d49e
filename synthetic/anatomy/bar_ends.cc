#include "synthetic/anatomy/bar_ends.h"

#include "synthetic/anatomy/nearest_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace pelvireg::anatomy
{
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace
{
constexpr double least_weight = 1e-6;
constexpr int n_parts = 8; ///< of a cell, to either side

using Shares = std::map<std::int32_t, double>;

/// Quadratic and piecewise linear shape functions of three nodes at 0, 1/2, 1.
std::array<double, 3> quadratic(double t)
{
  return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
}
std::array<double, 3> linear(double t)
{
  return {std::max(0., 1 - 2 * t), 1 - std::abs(2 * t - 1), std::max(0., 2 * t - 1)};
}

BarEnd end_of(const Vector3d &position, const Shares &shares)
{
  BarEnd end = {position, {}};
  double sum = 0;
  for (const auto &[node, weight] : shares)
    if (weight > least_weight)
    {
      end.nodes.emplace_back(node, weight);
      sum += weight;
    }
  for (auto &[node, weight] : end.nodes)
    weight /= sum;
  return end;
}

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
        add_cell(shell.cells, c);
    }
  for (const dataset::ReferenceSolid &solid : model.solids)
    if (solid.name == part)
    {
      points_ = solid.points;
      for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
        add_face(solid.faces, f);
    }
}

/// VTK_BIQUADRATIC_QUAD.
void BarSurface::add_cell(const dataset::Quads9 &cells, Eigen::Index cell)
{
  static constexpr int at[3][3] = {{0, 4, 1}, {7, 8, 5}, {3, 6, 2}}; // row, column
  const auto first = static_cast<int>(samples_.size()), width = n_parts + 1;
  for (int j = 0; j <= n_parts; ++j)
    for (int i = 0; i <= n_parts; ++i)
    {
      const double s = static_cast<double>(i) / n_parts, t = static_cast<double>(j) / n_parts;
      Vector3d position = Vector3d::Zero();
      Shares shares;
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
        {
          const auto k = static_cast<std::size_t>(column), l = static_cast<std::size_t>(row);
          const std::int32_t n = cells(cell, at[row][column]);
          position += quadratic(s)[k] * quadratic(t)[l] * node(n);
          shares[n] += linear(s)[k] * linear(t)[l];
        }
      samples_.push_back(end_of(position, shares));
      if (i == n_parts || j == n_parts)
        continue;
      const int corner = first + j * width + i;
      triangles_.emplace_back(corner, corner + 1, corner + width + 1);
      triangles_.emplace_back(corner, corner + width + 1, corner + width);
    }
}

/// VTK_QUADRATIC_TRIANGLE.
void BarSurface::add_face(const dataset::Triangles6 &faces, Eigen::Index face)
{
  static constexpr int opposite[3] = {4, 5, 3}; // the mid-side node that lies opposite to a corner
  std::map<std::pair<int, int>, int> sample_at;
  for (int j = 0; j <= n_parts; ++j)
    for (int i = 0; i + j <= n_parts; ++i)
    {
      const Vector3d l = Vector3d(n_parts - i - j, i, j) / n_parts;
      Vector3d position = Vector3d::Zero();
      Shares shares;
      for (int k = 0; k < 3; ++k)
      {
        const double a = l[(k + 1) % 3], b = l[(k + 2) % 3];
        position += l[k] * (2 * l[k] - 1) * node(faces(face, k)) + 4 * a * b * node(faces(face, opposite[k]));
        // In the quarter at a corner its own hat is 2 l - 1; in the middle one the hats of the mid-sides are 1 - 2 l.
        const int corner = l[0] >= 0.5 ? 0 : l[1] >= 0.5 ? 1 : l[2] >= 0.5 ? 2 : -1;
        shares[faces(face, k)] += k == corner ? 2 * l[k] - 1 : 0;
        shares[faces(face, opposite[k])] += corner < 0 ? 1 - 2 * l[k] : k == corner ? 0 : 2 * l[3 - k - corner];
      }
      sample_at[{i, j}] = static_cast<int>(samples_.size());
      samples_.push_back(end_of(position, shares));
    }
  for (int j = 0; j < n_parts; ++j)
    for (int i = 0; i + j < n_parts; ++i)
    {
      const int a = sample_at.at({i, j}), b = sample_at.at({i + 1, j}), c = sample_at.at({i, j + 1});
      triangles_.emplace_back(a, b, c);
      if (i + j + 2 <= n_parts)
        triangles_.emplace_back(b, sample_at.at({i + 1, j + 1}), c);
    }
}

BarEnd BarSurface::closest(const Vector3d &point) const
{
  Vector3d position = Vector3d::Zero();
  const Vector3i *best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto sample = [&](int i) -> const BarEnd & { return samples_[static_cast<std::size_t>(i)]; };
  for (const Vector3i &triangle : triangles_)
  {
    const Vector3d nearest = nearest_on_triangle(point, sample(triangle[0]).position, sample(triangle[1]).position,
                                                 sample(triangle[2]).position);
    if (const double distance = (nearest - point).squaredNorm(); distance < least)
    {
      least = distance;
      position = nearest;
      best = &triangle;
    }
  }
  const Vector3d weights =
      barycentric(position, sample((*best)[0]).position, sample((*best)[1]).position, sample((*best)[2]).position);
  Shares shares;
  for (int k = 0; k < 3; ++k)
    for (const auto &[node, share] : sample((*best)[k]).nodes)
      shares[node] += std::max(0., weights[k]) * share;
  return end_of(position, shares);
}

std::vector<LoopPart> equal_parts(const dataset::Points &points, const dataset::Integers &loop)
{
  constexpr int n = 6;
  std::vector<LoopPart> parts;
  for (Eigen::Index i = 0; i < loop.size(); i += 2)
  {
    const std::array<std::int32_t, 3> edge = {loop[i], loop[i + 1], loop[(i + 2) % loop.size()]};
    const auto at = [&](double t)
    {
      Vector3d position = Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        position += quadratic(t)[k] * points.row(edge[k]).transpose();
      return position;
    };
    for (int part = 0; part < n; ++part)
    {
      const double from = static_cast<double>(part) / n, to = (part + 1.) / n, t = (from + to) / 2;
      const double first = std::max(0., 1 - 3 * t), last = std::max(0., 3 * t - 2);
      parts.push_back({end_of(at(t), {{edge[0], first}, {edge[1], 1 - first - last}, {edge[2], last}}),
                       (at(to) - at(from)).norm()});
    }
  }
  return parts;
}
} // namespace pelvireg::anatomy
