#include "validation/metrics/surface_distance.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace pelvireg::metrics
{
namespace
{
constexpr int leaf_size = 4;

double squared_distance_to_box(const Eigen::Vector3d &p, const Eigen::Vector3d &lower, const Eigen::Vector3d &upper)
{
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0).squaredNorm();
}
} // namespace

bool is_scored(std::int32_t region)
{
  return region != static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
}

void require_usable_surface(const dataset::Points &points, const dataset::Triangles &triangles,
                            const dataset::Integers &region)
{
  if (triangles.rows() == 0)
    throw InputError("surface: got no triangles, at least one is needed; the organ is empty");
  if (region.size() != triangles.rows())
    throw InputError(fmt::format("surface: got {} region codes for {} triangles, must be one each", region.size(),
                                 triangles.rows()));
  if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= points.rows())
    throw InputError(fmt::format("surface: triangle indices reach from {} to {}, allowed is 0 to {}",
                                 triangles.minCoeff(), triangles.maxCoeff(), points.rows() - 1));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).allFinite())
      throw InputError(fmt::format("surface: position of node {} is ({}, {}, {}), must be finite; compute it again", i,
                                   points(i, 0), points(i, 1), points(i, 2)));
}

SurfaceTree::SurfaceTree(const dataset::Points &points, const dataset::Triangles &triangles,
                         const dataset::Integers &region)
{
  require_usable_surface(points, triangles, region);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (is_scored(region[t]))
    {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.row(k) = points.row(triangles(t, k));
      unsorted_corners_.push_back(corners);
      unsorted_rows_.push_back(static_cast<int>(t));
    }
  if (unsorted_corners_.empty())
    throw InputError("surface: every triangle is a cap, so there is nothing to measure to; check the regions");

  std::vector<int> order(unsorted_corners_.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * order.size());
  nodes_.emplace_back();
  split(0, order, 0, static_cast<int>(order.size()));
  unsorted_corners_ = {};
  unsorted_rows_ = {};
}

void SurfaceTree::split(int node, std::vector<int> &order, int begin, int end)
{
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;
  for (int i = begin; i < end; ++i)
  {
    const Eigen::Matrix3d &corners = unsorted_corners_[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    lower = lower.cwiseMin(corners.colwise().minCoeff().transpose());
    upper = upper.cwiseMax(corners.colwise().maxCoeff().transpose());
  }
  nodes_[static_cast<std::size_t>(node)].lower = lower;
  nodes_[static_cast<std::size_t>(node)].upper = upper;
  if (end - begin <= leaf_size)
  {
    nodes_[static_cast<std::size_t>(node)].first = static_cast<int>(corners_.size());
    nodes_[static_cast<std::size_t>(node)].n = end - begin;
    for (int i = begin; i < end; ++i)
    {
      corners_.push_back(unsorted_corners_[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
      rows_.push_back(unsorted_rows_[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
    }
    return;
  }

  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [this, axis](int i, int j)
                   {
                     const double x = unsorted_corners_[static_cast<std::size_t>(i)].col(axis).sum();
                     const double y = unsorted_corners_[static_cast<std::size_t>(j)].col(axis).sum();
                     return x < y || (x == y && i < j);
                   });
  const int left = static_cast<int>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[static_cast<std::size_t>(node)].first = left;
  split(left, order, begin, middle);
  split(left + 1, order, middle, end);
}

ClosestPoint SurfaceTree::closest(const Eigen::Vector3d &p) const
{
  ClosestPoint found;
  double best = std::numeric_limits<double>::infinity();
  std::array<int, 64> stack; // halving: the depth stays below log2 of the triangle count
  stack[0] = 0;
  for (int n_stacked = 1; n_stacked > 0;)
  {
    const Node &node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(--n_stacked)])];
    if (squared_distance_to_box(p, node.lower, node.upper) >= best)
      continue;
    for (int i = node.first; i < node.first + node.n; ++i)
    {
      const Eigen::Matrix3d &corners = corners_[static_cast<std::size_t>(i)];
      const Eigen::Vector3d foot = closest_point_on_triangle(p, corners.row(0), corners.row(1), corners.row(2));
      if (const double squared_distance = (foot - p).squaredNorm(); squared_distance < best)
      {
        best = squared_distance;
        found.position = foot;
        found.triangle = rows_[static_cast<std::size_t>(i)];
      }
    }
    if (node.n > 0)
      continue;
    const Node &left = nodes_[static_cast<std::size_t>(node.first)];
    const Node &right = nodes_[static_cast<std::size_t>(node.first) + 1];
    const bool left_is_nearer =
        squared_distance_to_box(p, left.lower, left.upper) <= squared_distance_to_box(p, right.lower, right.upper);
    stack[static_cast<std::size_t>(n_stacked++)] = left_is_nearer ? node.first + 1 : node.first;
    stack[static_cast<std::size_t>(n_stacked++)] = left_is_nearer ? node.first : node.first + 1;
  }
  found.distance = std::sqrt(best);
  return found;
}

std::vector<double> surface_distances(const dataset::Points &samples, const SurfaceTree &surface)
{
  if (samples.rows() == 0)
    throw InputError("surface distance: got no samples, at least one is needed");
  if (!samples.allFinite())
    throw InputError("surface distance: a sample's position is not finite; the truth's displacements are broken");
  std::vector<double> distances;
  distances.reserve(static_cast<std::size_t>(samples.rows()));
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
    distances.push_back(surface.distance(samples.row(i)));
  return distances;
}

std::vector<double> surface_distances(const dataset::Points &samples, const dataset::Points &points,
                                      const dataset::Triangles &triangles, const dataset::Integers &region)
{
  return surface_distances(samples, SurfaceTree(points, triangles, region));
}
} // namespace pelvireg::metrics
