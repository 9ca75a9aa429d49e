#include "synthetic/dataset/error.h"
#include "validation/metrics/outline_error.h"
#include "validation/runner/outline_tracking.h"

#include <fmt/format.h>

#include <algorithm>

namespace pelvireg::runner
{
namespace
{
using dataset::Points;

const dataset::TruthSurface &surface_of(const dataset::Truth &truth, const std::string &organ)
{
  for (const dataset::TruthSurface &surface : truth.surfaces)
    if (surface.name == organ)
      return surface;
  throw InputError(fmt::format("contour errors: the truth has no surface '{}'; run 'pelvireg reference' again", organ));
}

/// The contours of one organ in one frame, or at rest.
template <class Contours>
std::vector<Points> points_of(const std::string &organ, const TrackedSeries &tracked, const Contours &contours)
{
  std::vector<Points> points;
  for (std::size_t c = 0; c < tracked.rest.size(); ++c)
    if (tracked.rest[c].organ == organ)
      points.push_back(contours[c].points);
  return points;
}

struct Mean
{
  int n = 0;
  double mean = 0, hd95 = 0, normal = 0, tangential = 0, worst = 0;
};
} // namespace

std::vector<ContourErrorRow> contour_errors(const TrackedSeries &tracked, const dataset::Truth &truth,
                                            const dataset::Plane &plane, int frames_per_increment)
{
  if (tracked.frames.size() != truth.increments.size() * static_cast<std::size_t>(frames_per_increment) + 1)
    throw InputError(fmt::format("contour errors: {} frames are tracked, must be {}: the rest state and {} a truth "
                                 "increment; make the images again",
                                 tracked.frames.size(), truth.increments.size() * frames_per_increment + 1,
                                 frames_per_increment));
  std::vector<ContourErrorRow> rows;
  for (const std::string &organ : dataset::organ_names)
  {
    const dataset::TruthSurface &surface = surface_of(truth, organ);
    const metrics::OutlineTruth outline(surface.rest, points_of(organ, tracked, tracked.rest), plane);
    for (std::size_t frame = 0; frame < tracked.frames.size(); ++frame)
    {
      const Points positions = metrics::interpolated_positions(surface.rest, surface.displacements,
                                                               static_cast<double>(frame) / frames_per_increment);
      const auto error = outline.error(positions, points_of(organ, tracked, tracked.frames[frame]));
      rows.push_back({tracked.tracker, organ, static_cast<int>(frame), error.n_points, error.mean, error.hd95,
                      error.normal, error.tangential});
    }
  }
  return rows;
}

std::string contour_error_csv(const std::vector<ContourErrorRow> &rows)
{
  std::string text = "tracker,organ,frame,n_points,mean_mm,hd95_mm,normal_mm,tangential_mm\n";
  for (const ContourErrorRow &row : rows)
    text += fmt::format("{},{},{},{},{:.9g},{:.9g},{:.9g},{:.9g}\n", row.tracker, row.organ, row.frame, row.n_points,
                        row.mean, row.hd95, row.normal, row.tangential);
  return text;
}

std::string contour_error_table(const std::vector<ContourErrorRow> &rows)
{
  std::vector<std::string> trackers;
  for (const ContourErrorRow &row : rows)
    if (std::find(trackers.begin(), trackers.end(), row.tracker) == trackers.end())
      trackers.push_back(row.tracker);
  std::string text = "Contour error in the images, means over the frames after the first, mm (worst: largest frame "
                     "mean).\nNormal, tangential: drift of material points across and along the outline.\n\n";
  text += fmt::format("{:<12}{:<10}{:>8}{:>8}{:>8}{:>8}{:>12}\n", "tracker", "organ", "mean", "worst", "HD95", "normal",
                      "tangential");
  for (const std::string &tracker : trackers)
    for (const std::string &organ : dataset::organ_names)
    {
      Mean sum;
      for (const ContourErrorRow &row : rows)
        if (row.tracker == tracker && row.organ == organ && row.frame > 0)
        {
          ++sum.n;
          sum.mean += row.mean;
          sum.hd95 += row.hd95;
          sum.normal += row.normal;
          sum.tangential += row.tangential;
          sum.worst = std::max(sum.worst, row.mean);
        }
      if (sum.n > 0)
        text += fmt::format("{:<12}{:<10}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.2f}{:>12.2f}\n", tracker, organ, sum.mean / sum.n,
                            sum.worst, sum.hd95 / sum.n, sum.normal / sum.n, sum.tangential / sum.n);
    }
  return text;
}

std::string tracked_point_csv(const TrackedSeries &tracked)
{
  std::string text = "tracker,organ,contour,frame,point,x_mm,y_mm,z_mm,confidence,is_lost\n";
  for (std::size_t c = 0; c < tracked.rest.size(); ++c)
    for (std::size_t frame = 0; frame < tracked.frames.size(); ++frame)
    {
      const TrackedContour &contour = tracked.frames[frame][c];
      for (Eigen::Index i = 0; i < contour.points.rows(); ++i)
        text += fmt::format("{},{},{},{},{},{:.9g},{:.9g},{:.9g},{:.4f},{}\n", tracked.tracker, tracked.rest[c].organ,
                            c, frame, i, contour.points(i, 0), contour.points(i, 1), contour.points(i, 2),
                            contour.confidence[i], static_cast<int>(contour.is_lost[static_cast<std::size_t>(i)]));
    }
  return text;
}
} // namespace pelvireg::runner
