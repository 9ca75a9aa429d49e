#include "synthetic/dataset/error.h"
#include "validation/runner/outline_tracking.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace pelvireg::runner
{
namespace
{
using dataset::Points;

constexpr Eigen::Index reach = 3; // points of the outline (mm apart) on either side that give its direction

/// Where a control point lies on an outline at rest.
struct Place
{
  std::size_t contour = 0;
  Eigen::Index segment = 0;
  double share = 0;
};

Place place_of(const Eigen::Vector3d &point, const std::string &organ, const std::vector<OrganContour> &contours)
{
  Place best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < contours.size(); ++c)
    for (Eigen::Index i = 0, n = contours[c].points.rows(); i < n && contours[c].organ == organ; ++i)
    {
      const Eigen::Vector3d a = contours[c].points.row(i), b = contours[c].points.row((i + 1) % n);
      const double squared_length = (b - a).squaredNorm();
      const double share = squared_length > 0 ? std::clamp((point - a).dot(b - a) / squared_length, 0.0, 1.0) : 0;
      const double squared_distance = (a + share * (b - a) - point).squaredNorm();
      if (squared_distance < least)
      {
        least = squared_distance;
        best = {c, i, share};
      }
    }
  return best;
}

/// Unit direction of a closed polyline around a segment.
Eigen::Vector3d direction_at(const Points &points, Eigen::Index segment)
{
  const Eigen::Index n = points.rows(), before = (segment + n - reach) % n, after = (segment + 1 + reach) % n;
  return (points.row(after) - points.row(before)).transpose().stableNormalized();
}

/// The frame's polyline with normals along the segments, on the side on which `rest` has them.
dataset::Contour contour_of(const Points &points, const OrganContour &rest, const Eigen::Vector3d &plane_normal)
{
  const Eigen::Index n = points.rows();
  dataset::Contour contour{points, Points(n, 3), rest.region};
  double area = 0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::Vector3d a = points.row(i), b = points.row((i + 1) % n);
    area += plane_normal.dot((a - points.row(0).transpose()).cross(b - points.row(0).transpose()));
    contour.segment_normals.row(i) = (b - a).cross(plane_normal).stableNormalized();
  }
  if (area < 0)
    contour.segment_normals *= -1;
  return contour;
}

/// Of every organ's control points, in the order of exact.rest.
std::vector<std::vector<Place>> places_of(const TrackedSeries &tracked, const dataset::Observations &exact)
{
  std::vector<std::vector<Place>> places;
  for (std::size_t organ = 0; organ < exact.rest.outlines.size(); ++organ)
  {
    const Points &control = exact.rest.control_points[organ];
    std::vector<Place> &of_organ = places.emplace_back();
    for (Eigen::Index i = 0; i < control.rows(); ++i)
      of_organ.push_back(place_of(control.row(i), exact.rest.outlines[organ].organ, tracked.rest));
  }
  return places;
}

dataset::DynamicFrame frame_of(const TrackedSeries &tracked, std::size_t frame, const dataset::Observations &exact,
                               const std::vector<std::vector<Place>> &places)
{
  dataset::DynamicFrame moved;
  const std::vector<TrackedContour> &now = tracked.frames[frame];
  for (std::size_t organ = 0; organ < exact.rest.outlines.size(); ++organ)
  {
    const std::string &name = exact.rest.outlines[organ].organ;
    dataset::OrganOutline &outline = moved.outlines.emplace_back(dataset::OrganOutline{name, {}});
    for (std::size_t c = 0; c < now.size(); ++c)
      if (tracked.rest[c].organ == name)
        outline.contours.push_back(contour_of(now[c].points, tracked.rest[c], exact.dyn_plane.normal));

    const Points &control = exact.rest.control_points[organ], &normals = exact.rest.control_point_normals[organ];
    Points points(control.rows(), 3), turned(control.rows(), 3);
    Eigen::Index kept = 0;
    for (Eigen::Index i = 0; i < control.rows(); ++i)
    {
      const Place &place = places[organ][static_cast<std::size_t>(i)];
      const TrackedContour &contour = now[place.contour];
      const Eigen::Index next = (place.segment + 1) % contour.points.rows();
      const Eigen::Index nearest = place.share < 0.5 ? place.segment : next;
      if (contour.is_lost[static_cast<std::size_t>(nearest)])
        continue;
      points.row(kept) = (1 - place.share) * contour.points.row(place.segment) + place.share * contour.points.row(next);
      const Eigen::Vector3d before = direction_at(tracked.rest[place.contour].points, place.segment);
      const Eigen::Vector3d after = direction_at(contour.points, place.segment);
      const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(before, after);
      turned.row(kept++) = (turn * Eigen::Vector3d(normals.row(i))).normalized();
    }
    moved.control_points.push_back(points.topRows(kept));
    moved.control_point_normals.push_back(turned.topRows(kept));
  }
  return moved;
}
} // namespace

dataset::Observations observations_of(const TrackedSeries &tracked, const dataset::Observations &exact,
                                      int frames_per_increment)
{
  if (frames_per_increment < 1 || tracked.frames.size() % static_cast<std::size_t>(frames_per_increment) != 1)
    throw InputError(fmt::format("track: {} frames are tracked, must be one more than a multiple of {} (the frames an "
                                 "increment); make the images again",
                                 tracked.frames.size(), frames_per_increment));
  dataset::Observations observations;
  observations.case_name = exact.case_name;
  observations.dyn_plane = exact.dyn_plane;
  observations.rest = exact.rest;
  const std::size_t step = static_cast<std::size_t>(frames_per_increment);
  const std::vector<std::vector<Place>> places = places_of(tracked, exact);
  for (std::size_t frame = step; frame < tracked.frames.size(); frame += step)
  {
    observations.frames.push_back(frame_of(tracked, frame, exact, places));
    observations.frames.back().increment = static_cast<int>(frame / step);
  }
  return observations;
}
} // namespace pelvireg::runner
