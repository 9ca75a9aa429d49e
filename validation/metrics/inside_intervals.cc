#include "validation/metrics/inside_intervals.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pelvireg::metrics
{
namespace
{
constexpr double farthest_in_spacings = 2000;

struct Crossing
{
  std::int64_t line;
  double along; ///< mm
  int sign;     ///< +1 where the line enters, -1 where it leaves
};

/// Lines run along the third axis. The turn has no meaning beside being far from the body's axes.
dataset::Points turned(const dataset::Points &points)
{
  const Eigen::Matrix3d turn = Eigen::Quaterniond(0.8, 0.36, -0.23, 0.41).normalized().toRotationMatrix();
  return points * turn.transpose();
}

std::int64_t line_number(int column, int row)
{
  return (static_cast<std::int64_t>(row) << 32) + column;
}

/// Where an edge passes the plane of a row of lines: the same bits for both of its triangles.
Eigen::Vector2d edge_in_row(const dataset::Points &points, int a, int b, double y)
{
  if (a > b)
    std::swap(a, b);
  const double share = (y - points(a, 1)) / (points(b, 1) - points(a, 1));
  return {points(a, 0) + share * (points(b, 0) - points(a, 0)), points(a, 2) + share * (points(b, 2) - points(a, 2))};
}

class Crossings
{
public:
  Crossings(const dataset::Points &points, double spacing) : points_(points), spacing_(spacing) {}

  void add_triangle(const std::array<int, 3> &nodes)
  {
    const double lowest = std::min({points_(nodes[0], 1), points_(nodes[1], 1), points_(nodes[2], 1)});
    const double highest = std::max({points_(nodes[0], 1), points_(nodes[1], 1), points_(nodes[2], 1)});
    for (int row = first_at(lowest); place(row) < highest; ++row)
      add_row(nodes, row);
  }

  std::vector<Crossing> sorted()
  {
    std::sort(crossings_.begin(), crossings_.end(),
              [](const Crossing &a, const Crossing &b)
              { return a.line < b.line || (a.line == b.line && a.along < b.along); });
    return std::move(crossings_);
  }

private:
  double place(int index) const { return (index + 0.5) * spacing_; }
  /// The first line at or above a coordinate.
  int first_at(double coordinate) const
  {
    int index = static_cast<int>(std::floor(coordinate / spacing_ - 0.5));
    while (place(index) < coordinate)
      ++index;
    return index;
  }

  void add_row(const std::array<int, 3> &nodes, int row)
  {
    const double y = place(row);
    Eigen::Vector2d down = Eigen::Vector2d::Zero(),
                    up = down; // where the triangle's border, as it is oriented, passes the row
    int n_passed = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int a = nodes[k], b = nodes[(k + 1) % 3];
      const bool a_is_above = points_(a, 1) > y, b_is_above = points_(b, 1) > y;
      if (a_is_above == b_is_above)
        continue;
      ++n_passed;
      (b_is_above ? up : down) = edge_in_row(points_, a, b, y);
    }
    if (n_passed == 2)
      add_segment(down, up, row);
  }

  void add_segment(const Eigen::Vector2d &down, const Eigen::Vector2d &up, int row)
  {
    const double left = std::min(down.x(), up.x()), right = std::max(down.x(), up.x());
    for (int column = first_at(left); place(column) < right; ++column)
    {
      const double share = (place(column) - down.x()) / (up.x() - down.x());
      crossings_.push_back(
          {line_number(column, row), down.y() + share * (up.y() - down.y()), down.x() < up.x() ? -1 : 1});
    }
  }

  const dataset::Points &points_;
  double spacing_;
  std::vector<Crossing> crossings_;
};

void require_usable(const dataset::Points &points, const dataset::Triangles &triangles, double spacing)
{
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw InputError(fmt::format("volume in common: lines are {} mm apart, must be a positive number", spacing));
  if (triangles.rows() == 0 || triangles.minCoeff() < 0 || triangles.maxCoeff() >= points.rows())
    throw InputError(fmt::format("volume in common: {} triangles over {} points, there must be some and their nodes in "
                                 "range",
                                 triangles.rows(), points.rows()));
  // The crossings of a surface that has flown apart would fill the memory.
  if (!points.allFinite() || !(points.cwiseAbs().maxCoeff() <= farthest_in_spacings * spacing))
    throw InputError(
        fmt::format("volume in common: a position is not finite or farther than {} mm from the origin; the "
                    "positions are broken",
                    farthest_in_spacings * spacing));
}
} // namespace

InsideIntervals::InsideIntervals(const dataset::Points &points, const dataset::Triangles &triangles, double spacing)
    : spacing_(spacing)
{
  require_usable(points, triangles, spacing);
  const dataset::Points positions = turned(points);
  Crossings crossings(positions, spacing);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    crossings.add_triangle({triangles(t, 0), triangles(t, 1), triangles(t, 2)});

  int winding = 0;
  std::int64_t line = 0;
  for (const Crossing &crossing : crossings.sorted())
  {
    if (winding != 0 && crossing.line != line)
      break;
    line = crossing.line;
    if (winding == 0 && crossing.sign > 0)
      intervals_.push_back({line, crossing.along, crossing.along});
    winding += crossing.sign;
    if (winding == 0 && crossing.sign < 0)
      intervals_.back().end = crossing.along;
  }
  if (winding != 0)
    throw InputError("volume in common: a line enters the surface and does not leave it; a closed surface is needed");
}

double InsideIntervals::volume() const
{
  double length = 0;
  for (const Interval &interval : intervals_)
    length += interval.end - interval.begin;
  return length * spacing_ * spacing_;
}

double InsideIntervals::common_volume(const InsideIntervals &other) const
{
  if (spacing_ != other.spacing_)
    throw InputError(
        fmt::format("volume in common: lines are {} and {} mm apart, must be the same", spacing_, other.spacing_));
  const auto is_before = [](const Interval &a, const Interval &b)
  { return a.line < b.line || (a.line == b.line && a.end <= b.begin); };
  double length = 0;
  auto a = intervals_.begin();
  for (auto b = other.intervals_.begin(); a != intervals_.end() && b != other.intervals_.end();)
  {
    if (is_before(*a, *b))
      ++a;
    else if (is_before(*b, *a))
      ++b;
    else
    {
      length += std::min(a->end, b->end) - std::max(a->begin, b->begin);
      ++(a->end < b->end ? a : b);
    }
  }
  return length * spacing_ * spacing_;
}

double dice(const InsideIntervals &a, const InsideIntervals &b)
{
  const double sum = a.volume() + b.volume();
  if (!(sum > 0))
    throw InputError("Dice: nothing is inside either surface; check that they are closed and their normals outward");
  return 2 * a.common_volume(b) / sum;
}
} // namespace pelvireg::metrics
