#include "validation/metrics/outline_error.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/closest_point.h"
#include "validation/metrics/contour_distance.h"
#include "validation/metrics/material_points.h"
#include "validation/metrics/symmetric_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
using dataset::Points;

constexpr double spacing = 1.0;     // mm between samples of an outline
constexpr double on_surface = 0.25; // mm: a point farther from every scored triangle lies on a cap

bool shows_border(std::int32_t region)
{
  return region == static_cast<std::int32_t>(dataset::SurfaceRegion::wall) ||
         region == static_cast<std::int32_t>(dataset::SurfaceRegion::peritoneal);
}

/// The segments of closed polylines whose two ends are scored.
std::vector<CutSegment> scored_segments(const std::vector<Points> &contours,
                                        const std::vector<std::vector<char>> &is_scored)
{
  std::vector<CutSegment> segments;
  for (std::size_t c = 0; c < contours.size(); ++c)
    for (Eigen::Index i = 0, n = contours[c].rows(); i < n; ++i)
    {
      const Eigen::Index next = (i + 1) % n;
      CutSegment segment;
      segment.ends[0].position = contours[c].row(i);
      segment.ends[1].position = contours[c].row(next);
      if (is_scored[c][static_cast<std::size_t>(i)] && is_scored[c][static_cast<std::size_t>(next)] &&
          segment.length() > 0)
        segments.push_back(segment);
    }
  return segments;
}

struct Foot
{
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit, of the closest segment
};

Foot closest(const Eigen::Vector3d &point, const std::vector<CutSegment> &segments)
{
  Foot best;
  for (const CutSegment &segment : segments)
  {
    const Eigen::Vector3d &a = segment.ends[0].position, &b = segment.ends[1].position;
    const double distance = (closest_point_on_segment(point, a, b) - point).norm();
    if (distance < best.distance)
      best = {distance, (b - a).normalized()};
  }
  return best;
}
} // namespace

OutlineTruth::OutlineTruth(const dataset::SurfaceMesh &rest, std::vector<Points> contours, const dataset::Plane &plane)
    : rest_(rest), plane_(plane)
{
  for (const Points &contour : contours)
  {
    material_points_.push_back(closest_samples(rest, contour));
    const Points feet = sample_positions(material_points_.back(), rest.triangles, rest.points);
    std::vector<char> &is_scored = is_scored_.emplace_back();
    for (Eigen::Index i = 0; i < contour.rows(); ++i)
    {
      const int triangle = material_points_.back()[static_cast<std::size_t>(i)].triangle;
      is_scored.push_back(shows_border(rest.region[triangle]) && (feet.row(i) - contour.row(i)).norm() < on_surface);
    }
  }
  if (scored_segments(contours, is_scored_).empty())
    throw InputError("outline error: no part of the outline lies on the truth's surface at rest where an image shows a "
                     "border; start from the rest outline in observations.h5");
}

std::vector<CutSegment> OutlineTruth::true_outline(const Points &positions) const
{
  std::vector<CutSegment> segments = cut_surface(positions, rest_.triangles, rest_.region, plane_);
  std::erase_if(segments, [&](const CutSegment &segment) { return !shows_border(rest_.region[segment.triangle]); });
  if (segments.empty())
    throw InputError("outline error: the plane misses the truth's surface, it must cut every organ in every frame; "
                     "check the case's DYN plane");
  return segments;
}

OutlineTruth::Error OutlineTruth::error(const Points &positions, const std::vector<Points> &tracked) const
{
  if (tracked.size() != is_scored_.size())
    throw InputError(
        fmt::format("outline error: {} contours are given, must be {} as at rest", tracked.size(), is_scored_.size()));
  for (std::size_t c = 0; c < tracked.size(); ++c)
    if (tracked[c].rows() != static_cast<Eigen::Index>(is_scored_[c].size()) || !tracked[c].allFinite())
      throw InputError(fmt::format("outline error: contour {} (0-based) has {} points, must be {} finite ones", c,
                                   tracked[c].rows(), is_scored_[c].size()));

  const std::vector<CutSegment> truth = true_outline(positions), ours = scored_segments(tracked, is_scored_);
  const SymmetricDistance distance =
      symmetric_distance(contour_distances(truth, ours, spacing), contour_distances(ours, truth, spacing));
  Error error{.mean = distance.mean, .hd95 = distance.hd95};
  for (std::size_t c = 0; c < tracked.size(); ++c)
  {
    const Points places = sample_positions(material_points_[c], rest_.triangles, positions);
    for (Eigen::Index i = 0; i < places.rows(); ++i)
    {
      if (!is_scored_[c][static_cast<std::size_t>(i)])
        continue;
      const Eigen::Vector3d place = places.row(i), point = tracked[c].row(i);
      ++error.n_points;
      error.normal += closest(point, truth).distance;
      error.tangential += std::abs((point - place).dot(closest(place, truth).direction));
    }
  }
  error.normal /= error.n_points;
  error.tangential /= error.n_points;
  return error;
}

Points interpolated_positions(const dataset::SurfaceMesh &rest, const std::vector<Points> &displacements,
                              double increments)
{
  const double last = static_cast<double>(displacements.size());
  if (!(increments >= 0 && increments <= last))
    throw InputError(fmt::format("outline error: {} increments after rest, must lie in 0 … {}", increments, last));
  const std::size_t before = std::min(static_cast<std::size_t>(increments), displacements.size() - 1);
  const double share = increments - static_cast<double>(before);
  Points positions = rest.points + share * displacements[before];
  if (before > 0)
    positions += (1 - share) * displacements[before - 1];
  return positions;
}
} // namespace pelvireg::metrics
