#include "validation/cli/track_stage.h"

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/observation/images/image_files.h"
#include "validation/regression/result.h"
#include "validation/report/contour_error_figure.h"
#include "validation/report/track_figures.h"
#include "validation/runner/outline_tracking.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace pelvireg::cli
{
namespace
{
/// Frames an increment, from the numbers of both.
int frames_per_increment(const dataset::ImageSeries &series, const dataset::Observations &observations)
{
  const std::size_t frames = series.times_s.size(), increments = observations.frames.size();
  if (increments == 0 || frames < 2 || (frames - 1) % increments != 0)
    throw InputError(fmt::format("track: '{}' has {} frames for {} increments, must have one and a multiple of the "
                                 "increments; make the images again",
                                 dynamic_images, frames, increments));
  return static_cast<int>((frames - 1) / increments);
}

std::vector<std::string> trackers_of(const TrackRequest &request)
{
  std::vector<std::string> trackers = {request.tracker};
  for (const std::string &name : tracking::tracker_names())
    if (request.all && name != request.tracker)
      trackers.push_back(name);
  return trackers;
}

/// Every third of the sequence, tracked and true.
std::vector<report::OverlayFrame> overlay_of(const runner::TrackedSeries &tracked,
                                             const dataset::Observations &observations, int per_increment)
{
  std::vector<report::OverlayFrame> frames;
  const int n = static_cast<int>(observations.frames.size());
  for (const int increment : {0, n / 3, 2 * n / 3, n})
  {
    report::OverlayFrame &frame = frames.emplace_back();
    frame.frame = increment * per_increment;
    const std::vector<runner::TrackedContour> &contours = tracked.frames[static_cast<std::size_t>(frame.frame)];
    for (std::size_t c = 0; c < contours.size(); ++c)
      frame.outlines.push_back({tracked.rest[c].organ, contours[c].points, false});
    const dataset::DynamicFrame &exact =
        increment == 0 ? observations.rest : observations.frames[static_cast<std::size_t>(increment) - 1];
    for (const dataset::OrganOutline &outline : exact.outlines)
      for (const dataset::Contour &contour : outline.contours)
        frame.outlines.push_back({outline.organ, contour.points, true});
  }
  return frames;
}

Notes work(const std::filesystem::path &directory, const TrackRequest &request, Progress &progress)
{
  const dataset::Observations observations = dataset::load_observations(directory / "observations.h5");
  const dataset::Truth truth = dataset::load_truth(directory / "truth.h5");
  const dataset::ImageSeries series = observation::read_image_series(directory / dynamic_images);
  const int per_increment = frames_per_increment(series, observations);
  const std::vector<runner::OrganContour> rest = runner::rest_contours(observations.rest);

  Notes notes;
  std::vector<runner::ContourErrorRow> errors;
  for (const std::string &name : trackers_of(request))
  {
    runner::TrackOptions options{.tracker = name, .progress = progress.callback()};
    if (request.uterus_border)
      options.flow_only.clear();
    const runner::TrackedSeries tracked = runner::track(series, rest, options);
    const auto rows = runner::contour_errors(tracked, truth, observations.dyn_plane, per_increment);
    errors.insert(errors.end(), rows.begin(), rows.end());
    notes["frames_per_s " + name] = 1000 / tracked.processor_ms;
    if (name != request.tracker)
      continue;
    save(runner::observations_of(tracked, observations, per_increment), directory / "tracked.h5");
    dataset::write_text_file(directory / "tracked_points.csv", runner::tracked_point_csv(tracked));
    std::filesystem::create_directories(directory / "pictures");
    report::write_overlay(series, overlay_of(tracked, observations, per_increment), directory / tracked_picture);
  }
  dataset::write_text_file(directory / "contour_errors.csv", runner::contour_error_csv(errors));
  dataset::write_text_file(directory / "contour_table.txt", runner::contour_error_table(errors));
  dataset::write_text_file(directory / contour_error_figure, report::contour_error_figure(errors));
  return notes;
}

/// Mean surface error at the last step of the nominal run.
double last_error(const regression::Curves &curves, const std::string &condition, const std::string &organ)
{
  return curves.at({condition, organ, regression::Axis::step}).at(0).back().mean;
}
} // namespace

void make_tracked(ResultDirectory &directory, const TrackRequest &request)
{
  directory.run({.name = "track",
                 .code = {"registration/tracking", "validation/metrics", "validation/runner", "validation/report",
                          "synthetic/observation", "synthetic/observation/images", "synthetic/dataset"},
                 .options = fmt::format("tracker {} all {} uterus border {}", request.tracker, request.all,
                                        request.uterus_border),
                 .inputs = {"truth.h5", "observations.h5", dynamic_images},
                 .outputs = {"tracked.h5", "tracked_points.csv", "contour_errors.csv", "contour_table.txt",
                             tracked_picture, contour_error_figure},
                 .work = [&](Progress &progress) { return work(directory.path(), request, progress); }});
}

void print_contour_table(const ResultDirectory &directory)
{
  std::ostringstream table;
  table << std::ifstream(directory.path() / "contour_table.txt").rdbuf();
  fmt::print("\n{}\nframes a second on one core, four organs:", table.str());
  const auto stage = directory.manifest().stages.find("track");
  if (stage != directory.manifest().stages.end())
    for (const std::string &name : tracking::tracker_names())
      if (const auto note = stage->second.notes.find("frames_per_s " + name); note != stage->second.notes.end())
        fmt::print(" {} {:.0f}", name, note->second);
  fmt::print("\n");
}

std::string tracking_cost_table(const ResultDirectory &directory)
{
  const std::string file = "errors_by_step.csv", suffix = "_" + dataset::tracked_outlines;
  const regression::Curves curves = regression::read_curves(
      regression::read_text(directory.path() / file, "run 'pelvireg evaluate'"), regression::Axis::step, file);
  std::string rows;
  for (const auto &[family, runs] : curves)
    if (const std::string &condition = family.condition;
        family.organ == dataset::organ_names.front() &&
        curves.contains({condition + suffix, family.organ, regression::Axis::step}))
      for (const std::string &organ : dataset::organ_names)
      {
        const double exact = last_error(curves, condition, organ),
                     tracked = last_error(curves, condition + suffix, organ);
        rows +=
            fmt::format("{:<24}{:<10}{:>8.2f}{:>10.2f}{:>12.2f}\n", condition, organ, exact, tracked, tracked - exact);
      }
  if (rows.empty())
    return "";
  return fmt::format("What tracking costs: mean surface error at the last step, mm\n{:<24}{:<10}{:>8}{:>10}{:>12}\n{}",
                     "condition", "organ", "exact", "images", "difference", rows);
}
} // namespace pelvireg::cli
