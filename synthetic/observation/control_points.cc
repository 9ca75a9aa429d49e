#include "synthetic/observation/control_points.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector3d;

/// A maximal run of visible segments of a loop.
struct Stretch
{
  std::vector<Vector3d> points;       ///< one more than segments; first == last when closed
  std::vector<Vector3d> normals;      ///< by segment
  std::vector<double> arc_length;     ///< of each point from the first, mm
  std::vector<std::int32_t> triangle; ///< by segment
  bool closed = false;

  double length() const { return arc_length.back(); }
};

bool is_visible(std::int32_t region)
{
  return region == static_cast<std::int32_t>(dataset::SurfaceRegion::wall) ||
         region == static_cast<std::int32_t>(dataset::SurfaceRegion::peritoneal);
}

/// `n_segments` segments of the loop from segment `first` on.
Stretch take(const PlaneLoop &loop, Eigen::Index first, Eigen::Index n_segments)
{
  const Eigen::Index n = loop.contour.points.rows();
  Stretch stretch;
  stretch.closed = n_segments == n;
  stretch.arc_length = {0};
  stretch.points = {loop.contour.points.row(first)};
  for (Eigen::Index k = 0; k < n_segments; ++k)
  {
    const Eigen::Index i = (first + k) % n;
    stretch.normals.push_back(loop.contour.segment_normals.row(i));
    stretch.triangle.push_back(loop.triangle[i]);
    const Vector3d next = loop.contour.points.row((i + 1) % n);
    stretch.arc_length.push_back(stretch.length() + (next - stretch.points.back()).norm());
    stretch.points.push_back(next);
  }
  return stretch;
}

std::vector<Stretch> visible_stretches(const OrganSection &section)
{
  std::vector<Stretch> stretches;
  for (const PlaneLoop &loop : section.loops)
  {
    if (loop.area <= 0) // a hole is not the organ's outline
      continue;
    const auto &region = loop.contour.segment_region;
    const Eigen::Index n = region.size();
    const auto visible = [&](Eigen::Index i) { return is_visible(region[i % n]); };
    Eigen::Index n_starts = 0;
    for (Eigen::Index i = 0; i < n; ++i)
    {
      if (!visible(i + 1) || visible(i))
        continue;
      ++n_starts;
      Eigen::Index n_segments = 1;
      while (visible(i + 1 + n_segments))
        ++n_segments;
      stretches.push_back(take(loop, (i + 1) % n, n_segments));
    }
    if (n_starts == 0 && visible(0))
      stretches.push_back(take(loop, 0, n));
  }
  return stretches;
}

/// Without the scraps between ragged borders of regions.
std::vector<Stretch> long_stretches(const OrganSection &section, double spacing)
{
  std::vector<Stretch> stretches = visible_stretches(section);
  std::erase_if(stretches, [spacing](const Stretch &stretch) { return stretch.length() < 0.5 * spacing; });
  return stretches;
}

int rounded_count(const Stretch &stretch, double spacing)
{
  return static_cast<int>(std::lround(stretch.length() / spacing));
}

std::size_t segment_at(const Stretch &stretch, double s)
{
  const auto after = std::upper_bound(stretch.arc_length.begin(), stretch.arc_length.end(), s);
  const auto i = std::distance(stretch.arc_length.begin(), after) - 1;
  return std::clamp<std::ptrdiff_t>(i, 0, static_cast<std::ptrdiff_t>(stretch.normals.size()) - 1);
}

Vector3d point_at(const Stretch &stretch, double s)
{
  const std::size_t i = segment_at(stretch, s);
  const double t = (s - stretch.arc_length[i]) / (stretch.arc_length[i + 1] - stretch.arc_length[i]);
  return stretch.points[i] + t * (stretch.points[i + 1] - stretch.points[i]);
}

struct NearestOnStretch
{
  double arc_length = 0;
  double distance = std::numeric_limits<double>::infinity();
};

NearestOnStretch nearest(const Stretch &stretch, const Vector3d &point)
{
  NearestOnStretch best;
  for (std::size_t i = 0; i < stretch.normals.size(); ++i)
  {
    const Vector3d segment = stretch.points[i + 1] - stretch.points[i];
    const double t = std::clamp((point - stretch.points[i]).dot(segment) / segment.squaredNorm(), 0.0, 1.0);
    const double distance = (point - stretch.points[i] - t * segment).norm();
    if (distance < best.distance)
      best = {stretch.arc_length[i] + t * segment.norm(), distance};
  }
  return best;
}

double lowest_arc_length(const Stretch &stretch)
{
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < stretch.points.size(); ++i)
    if (stretch.points[i].z() < stretch.points[lowest].z())
      lowest = i;
  return stretch.arc_length[lowest];
}

Vector3d barycentric(const dataset::SurfaceMesh &surface, std::int32_t triangle, const Vector3d &point)
{
  const Vector3d a = surface.points.row(surface.triangles(triangle, 0));
  const Vector3d b = surface.points.row(surface.triangles(triangle, 1));
  const Vector3d c = surface.points.row(surface.triangles(triangle, 2));
  const Vector3d u = b - a, v = c - a, normal = u.cross(v);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0)) // a triangle without area: any of its vertices is as good
    return {1, 0, 0};
  const double wb = (point - a).cross(v).dot(normal) / area2, wc = u.cross(point - a).dot(normal) / area2;
  return {1 - wb - wc, wb, wc};
}

/// Mean of the adjacent visible triangles' normals, weighted by their angle at the vertex (caps would bend the normals
/// at a rim). Zero where no visible triangle meets the vertex.
dataset::Points vertex_normals(const dataset::SurfaceMesh &surface)
{
  dataset::Points normals = dataset::Points::Zero(surface.points.rows(), 3);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    if (surface.region.size() > 0 && !is_visible(surface.region[t]))
      continue;
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t vertex = surface.triangles(t, i);
      const Vector3d a = surface.points.row(vertex);
      const Vector3d u = surface.points.row(surface.triangles(t, (i + 1) % 3)).transpose() - a;
      const Vector3d v = surface.points.row(surface.triangles(t, (i + 2) % 3)).transpose() - a;
      const Vector3d normal = u.cross(v);
      if (normal.norm() > 0)
        normals.row(vertex) += std::atan2(normal.norm(), u.dot(v)) * normal.normalized();
    }
  }
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (normals.row(i).norm() > 0)
      normals.row(i).normalize();
  return normals;
}

/// The smooth surface's normal at a point of the stretch, projected into the plane.
Vector3d normal_at(const Stretch &stretch, double s, const OrganSection &section, const dataset::Points &normals)
{
  const std::size_t i = segment_at(stretch, s);
  const Vector3d segment_normal = stretch.normals[i];
  const Vector3d weights = barycentric(section.surface, stretch.triangle[i], point_at(stretch, s));
  Vector3d smooth = Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    smooth += weights[k] * normals.row(section.surface.triangles(stretch.triangle[i], k));
  const Vector3d across = (stretch.points[i + 1] - stretch.points[i]).cross(segment_normal).normalized();
  smooth -= smooth.dot(across) * across; // `across` is the plane's normal
  // A wall that folds sharply or meets the plane almost flat has no smooth normal: the segment's own is then used.
  return smooth.norm() > 1e-3 && smooth.dot(segment_normal) > 0 ? smooth.normalized() : segment_normal;
}

/// Shares in proportion to `lengths`, whole, of sum `total`: largest remainder, the earlier one first when equal.
std::vector<int> share_out(const std::vector<double> &lengths, int total)
{
  const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<int> shares;
  std::vector<double> remainders;
  for (const double length : lengths)
  {
    const double exact = total * length / sum;
    shares.push_back(static_cast<int>(exact));
    remainders.push_back(exact - shares.back());
  }
  int left = total - std::accumulate(shares.begin(), shares.end(), 0);
  std::vector<std::size_t> order(lengths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return remainders[i] > remainders[j]; });
  for (std::size_t k = 0; k < order.size() && left > 0; ++k, --left)
    ++shares[order[k]];
  return shares;
}

/// A stretch of a frame, how many points it gets, and where it starts.
struct Placement
{
  const Stretch *stretch = nullptr;
  int n_points = 0;
  double offset = 0; ///< arc length of the anchor, mm
};

ControlPoints distribute(const std::vector<Placement> &placements, const OrganSection &section)
{
  const dataset::Points normals = vertex_normals(section.surface);
  int total = 0;
  for (const Placement &placement : placements)
    total += placement.n_points;
  ControlPoints result{dataset::Points(total, 3), dataset::Points(total, 3)};
  Eigen::Index row = 0;
  for (const Placement &placement : placements)
    for (int j = 0; j < placement.n_points; ++j, ++row)
    {
      const double length = placement.stretch->length();
      double s = placement.offset + (j + 0.5) / placement.n_points * length;
      if (s >= length && placement.stretch->closed)
        s -= length;
      result.points.row(row) = point_at(*placement.stretch, s);
      result.normals.row(row) = normal_at(*placement.stretch, s, section, normals);
    }
  return result;
}

/// The unused stretch of the same kind nearest to where `start` has moved; its index.
std::optional<std::size_t> match(const std::vector<Stretch> &stretches, const std::vector<bool> &used, bool closed,
                                 const Vector3d &start)
{
  std::optional<std::size_t> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stretches.size(); ++i)
  {
    if (used[i] || stretches[i].closed != closed)
      continue;
    const double distance =
        closed ? nearest(stretches[i], start).distance : (stretches[i].points.front() - start).norm();
    if (distance < best_distance)
    {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}
} // namespace

ControlPointLayout::ControlPointLayout(const std::vector<OrganSection> &rest, int n_wanted, double spacing)
{
  double total = 0;
  for (const OrganSection &section : rest)
    for (const Stretch &stretch : visible_stretches(section))
      total += stretch.length();
  if (!(total > 0))
    throw InputError("The image plane meets no visible wall of any organ at rest, so that there is nothing to track; "
                     "move the plane's origin into the organs.");
  spacing_ = spacing > 0 ? spacing : total / n_wanted;

  std::vector<double> lengths;
  for (const OrganSection &section : rest)
  {
    rest_.emplace_back();
    for (const Stretch &stretch : long_stretches(section, spacing_))
    {
      const double anchor = stretch.closed ? lowest_arc_length(stretch) : 0;
      const std::int32_t triangle = stretch.triangle[segment_at(stretch, anchor)];
      const Vector3d weights = barycentric(section.surface, triangle, point_at(stretch, anchor));
      rest_.back().push_back({{triangle, weights}, stretch.closed, rounded_count(stretch, spacing_)});
      lengths.push_back(stretch.length());
    }
  }
  if (spacing > 0)
    return;
  std::size_t k = 0;
  const std::vector<int> shares = share_out(lengths, n_wanted);
  for (auto &stretches : rest_)
    for (RestStretch &stretch : stretches)
      stretch.n_points = shares[k++];
}

ControlPoints ControlPointLayout::place(std::size_t organ, const OrganSection &section) const
{
  const auto moved = [&](const MaterialPoint &point)
  {
    Vector3d position = Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      position += point.weights[i] * section.surface.points.row(section.surface.triangles(point.triangle, i));
    return position;
  };
  const std::vector<Stretch> stretches = long_stretches(section, spacing_);
  std::vector<Placement> placements;
  std::vector<bool> used(stretches.size(), false);
  for (const RestStretch &rest : rest_[organ])
    if (const auto i = match(stretches, used, rest.closed, moved(rest.start)))
    {
      used[*i] = true;
      const double offset = rest.closed ? nearest(stretches[*i], moved(rest.start)).arc_length : 0;
      placements.push_back({&stretches[*i], rest.n_points, offset});
    }
  if (placements.size() != rest_[organ].size() || placements.size() != stretches.size())
  {
    for (Placement &placement : placements)
      placement.n_points = rounded_count(*placement.stretch, spacing_);
    for (std::size_t i = 0; i < stretches.size(); ++i)
      if (!used[i])
        placements.push_back({&stretches[i], rounded_count(stretches[i], spacing_),
                              stretches[i].closed ? lowest_arc_length(stretches[i]) : 0});
  }
  return distribute(placements, section);
}
} // namespace pelvireg::observation
