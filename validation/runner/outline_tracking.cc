#include "validation/runner/outline_tracking.h"

#include "synthetic/dataset/error.h"
#include "validation/runner/image_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace pelvireg::runner
{
namespace
{
using dataset::Points;

constexpr double rest_spacing = 1.0; // mm between the points of an outline

/// Points `rest_spacing` apart along a closed contour, each with the region of the segment it lies on.
OrganContour resampled(const std::string &organ, const dataset::Contour &contour)
{
  const Eigen::Index n = contour.points.rows();
  Eigen::VectorXd length(n + 1);
  length[0] = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    length[i + 1] = length[i] + (contour.points.row((i + 1) % n) - contour.points.row(i)).norm();
  const Eigen::Index wanted = std::max<Eigen::Index>(8, std::lround(length[n] / rest_spacing));
  OrganContour even{organ, Points(wanted, 3), dataset::Integers(wanted)};
  Eigen::Index segment = 0;
  for (Eigen::Index k = 0; k < wanted; ++k)
  {
    const double at = length[n] * static_cast<double>(k) / static_cast<double>(wanted);
    while (segment + 1 < n && length[segment + 1] <= at)
      ++segment;
    const double share = (at - length[segment]) / std::max(length[segment + 1] - length[segment], 1e-12);
    even.points.row(k) = (1 - share) * contour.points.row(segment) + share * contour.points.row((segment + 1) % n);
    even.region[k] = contour.segment_region[segment];
  }
  return even;
}

std::vector<char> borders_of(const dataset::Integers &region)
{
  std::vector<char> has_border;
  for (const std::int32_t code : region)
    has_border.push_back(code == static_cast<std::int32_t>(dataset::SurfaceRegion::wall) ||
                         code == static_cast<std::int32_t>(dataset::SurfaceRegion::peritoneal));
  return has_border;
}

void require_in_plane(const dataset::ImageSeries &series, const OrganContour &contour)
{
  const double off = distance_from_plane(series.geometry, contour.points), allowed = 0.5 * series.slice_thickness_mm;
  if (!(off <= std::max(allowed, 1e-3)))
    throw InputError(fmt::format("track: the outline of {} lies up to {:.2f} mm from the image plane, at most half the "
                                 "slice thickness ({:.2f} mm) is allowed; draw it in the images that are tracked",
                                 contour.organ, off, allowed));
}

std::vector<TrackedContour> in_space(const dataset::ImageSeries &series, const tracking::TrackedFrame &frame)
{
  std::vector<TrackedContour> contours;
  for (const tracking::TrackedOutline &outline : frame.outlines)
    contours.push_back({to_space(series.geometry, outline.points), outline.confidence, outline.is_lost});
  return contours;
}

void follow(tracking::OutlineTracker &tracker, const dataset::ImageSeries &series,
            const std::vector<tracking::InitialOutline> &outlines, const TrackOptions &options, TrackedSeries &tracked)
{
  tracker.start(frame_of(series, 0), outlines);
  std::clock_t processor = 0;
  for (std::size_t frame = 1; frame < series.times_s.size(); ++frame)
  {
    const tracking::Image image = frame_of(series, frame);
    const std::clock_t start = std::clock();
    const tracking::TrackedFrame result = tracker.update(image);
    processor += std::clock() - start;
    tracked.frames.push_back(in_space(series, result));
    tracked.n_lost_joints.push_back(result.n_lost_joints);
    tracked.n_reacquired_joints.push_back(result.n_reacquired_joints);
    if (options.progress)
      options.progress(static_cast<double>(frame + 1) / static_cast<double>(series.times_s.size()),
                       fmt::format("{}: frame {} of {}", options.tracker, frame + 1, series.times_s.size()));
  }
  tracked.processor_ms = 1000.0 * static_cast<double>(processor) / CLOCKS_PER_SEC /
                         static_cast<double>(std::max<std::size_t>(1, series.times_s.size() - 1));
}
} // namespace

std::vector<OrganContour> rest_contours(const dataset::DynamicFrame &rest)
{
  std::vector<OrganContour> contours;
  for (const dataset::OrganOutline &outline : rest.outlines)
    for (const dataset::Contour &contour : outline.contours)
      contours.push_back(resampled(outline.organ, contour));
  return contours;
}

TrackedSeries track(const dataset::ImageSeries &series, const std::vector<OrganContour> &rest,
                    const TrackOptions &options)
{
  TrackedSeries tracked{.tracker = options.tracker,
                        .rest = rest,
                        .frames = {},
                        .n_lost_joints = {0},
                        .n_reacquired_joints = {0},
                        .processor_ms = 0};
  std::vector<TrackedContour> &first = tracked.frames.emplace_back();
  std::vector<tracking::InitialOutline> outlines;
  for (const OrganContour &contour : rest)
  {
    require_in_plane(series, contour);
    const auto is_organ = [&](const std::string &organ) { return organ == contour.organ; };
    const bool flow_only = std::any_of(options.flow_only.begin(), options.flow_only.end(), is_organ);
    outlines.push_back(
        {contour.organ, to_pixels(series.geometry, contour.points), borders_of(contour.region), flow_only});
    const auto n = static_cast<std::size_t>(contour.points.rows());
    first.push_back({to_space(series.geometry, outlines.back().points), Eigen::VectorXd::Ones(contour.points.rows()),
                     std::vector<char>(n, 0)});
  }
  try
  {
    follow(*tracking::make_tracker(options.tracker, options.options), series, outlines, options, tracked);
  }
  catch (const std::invalid_argument &problem)
  {
    throw InputError(fmt::format("track: {}", problem.what()));
  }
  return tracked;
}
} // namespace pelvireg::runner
