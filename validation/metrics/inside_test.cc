#include "validation/metrics/inside_test.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pelvireg::metrics
{
namespace
{
/// Where an edge passes y: x and z, the same bits for both of its triangles.
Eigen::Vector2d edge_at(const dataset::Points &points, int a, int b, double y)
{
  if (a > b)
    std::swap(a, b);
  const double share = (y - points(a, 1)) / (points(b, 1) - points(a, 1));
  return {points(a, 0) + share * (points(b, 0) - points(a, 0)), points(a, 2) + share * (points(b, 2) - points(a, 2))};
}

int place_of(double coordinate, double lower, double size, int n)
{
  return std::clamp(static_cast<int>((coordinate - lower) / size), 0, n - 1);
}
} // namespace

InsideTest::InsideTest(const dataset::Points &points, const dataset::Triangles &triangles) : points_(points)
{
  if (triangles.rows() == 0 || triangles.minCoeff() < 0 || triangles.maxCoeff() >= points.rows() || !points.allFinite())
    throw InputError(
        fmt::format("inside: {} triangles over {} points, there must be some, their nodes in range and all "
                    "positions finite",
                    triangles.rows(), points.rows()));
  lower_ = points.leftCols(2).colwise().minCoeff().transpose();
  upper_ = points.leftCols(2).colwise().maxCoeff().transpose();
  // About as many cells as triangles: some four triangles are asked.
  const int n = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(triangles.rows()))));
  n_columns_ = n_rows_ = n;
  cell_size_ = ((upper_ - lower_) / n).cwiseMax(1e-300);

  const auto for_each_entry = [&](const auto &visit)
  {
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    {
      const Eigen::Vector3i nodes = triangles.row(t).transpose();
      const auto [left, right] = std::minmax({points(nodes[0], 0), points(nodes[1], 0), points(nodes[2], 0)});
      const auto [front, back] = std::minmax({points(nodes[0], 1), points(nodes[1], 1), points(nodes[2], 1)});
      const int column = place_of(left, lower_.x(), cell_size_.x(), n),
                row = place_of(front, lower_.y(), cell_size_.y(), n);
      const int last_column = place_of(right, lower_.x(), cell_size_.x(), n);
      const int last_row = place_of(back, lower_.y(), cell_size_.y(), n);
      for (int j = row; j <= last_row; ++j)
        for (int i = column; i <= last_column; ++i)
          visit(static_cast<std::size_t>(j * n + i), nodes);
    }
  };
  first_.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) + 1, 0);
  for_each_entry([&](std::size_t cell, const Eigen::Vector3i &) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell)
    first_[cell] += first_[cell - 1];
  std::vector<int> next = first_;
  triangles_.resize(static_cast<std::size_t>(first_.back()));
  for_each_entry([&](std::size_t cell, const Eigen::Vector3i &nodes)
                 { triangles_[static_cast<std::size_t>(next[cell]++)] = nodes; });
}

int InsideTest::cell_of(double x, double y) const
{
  return place_of(y, lower_.y(), cell_size_.y(), n_rows_) * n_columns_ +
         place_of(x, lower_.x(), cell_size_.x(), n_columns_);
}

int InsideTest::winding(const Eigen::Vector3d &p, const Eigen::Vector3i &nodes) const
{
  Eigen::Vector2d down = Eigen::Vector2d::Zero(),
                  up = down; // where the triangle's border, as it is oriented, passes p.y
  int n_passed = 0;
  for (int k = 0; k < 3; ++k)
  {
    const int a = nodes[k], b = nodes[(k + 1) % 3];
    const bool a_is_above = points_(a, 1) > p.y(), b_is_above = points_(b, 1) > p.y();
    if (a_is_above == b_is_above)
      continue;
    ++n_passed;
    (b_is_above ? up : down) = edge_at(points_, a, b, p.y());
  }
  const bool down_is_left = n_passed == 2 && down.x() <= p.x(), up_is_left = n_passed == 2 && up.x() <= p.x();
  if (down_is_left == up_is_left)
    return 0;
  const double z = down.y() + (p.x() - down.x()) / (up.x() - down.x()) * (up.y() - down.y());
  if (!(z > p.z()))
    return 0;
  return down_is_left ? 1 : -1; // the half line leaves or enters
}

bool InsideTest::is_inside(const Eigen::Vector3d &p) const
{
  if (!(p.x() >= lower_.x() && p.x() <= upper_.x() && p.y() >= lower_.y() && p.y() <= upper_.y()))
    return false;
  const auto cell = static_cast<std::size_t>(cell_of(p.x(), p.y()));
  int sum = 0;
  for (int i = first_[cell]; i < first_[cell + 1]; ++i)
    sum += winding(p, triangles_[static_cast<std::size_t>(i)]);
  return sum > 0;
}
} // namespace pelvireg::metrics
