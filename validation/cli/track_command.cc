#include "registration/tracking/outline_tracker.h"
#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/image_files.h"
#include "validation/cli/commands.h"
#include "validation/cli/markups.h"
#include "validation/cli/track_stage.h"
#include "validation/report/track_figures.h"
#include "validation/runner/image_plane.h"
#include "validation/runner/outline_tracking.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace pelvireg::cli
{
namespace
{
constexpr double click_spacing = 1.0; // mm between the points of an outline that was drawn

struct Arguments
{
  std::string directory;
  TrackRequest request;
  std::string dicom, nrrd, out = "tracked";
  std::vector<std::string> contours;
};

/// Every curve as points on the spline through its control points, in the image plane.
std::vector<runner::OrganContour> drawn_contours(const dataset::ImageSeries &series,
                                                 const std::vector<std::string> &files)
{
  std::vector<runner::OrganContour> contours;
  for (const std::string &file : files)
    for (const ClosedCurve &curve : read_curves(file))
    {
      for (const runner::OrganContour &other : contours)
        if (other.organ == curve.organ)
          throw InputError(fmt::format(
              "--contours: {} is drawn twice, the second time in '{}'; give one curve an organ", curve.organ, file));
      const double off = runner::distance_from_plane(series.geometry, curve.points);
      const double allowed = std::max(0.5 * series.slice_thickness_mm, 1.0);
      if (off > allowed)
        throw InputError(
            fmt::format("'{}': the curve of {} lies up to {:.1f} mm from the image plane, at most {:.1f} mm "
                        "is allowed; draw it in the images that are tracked",
                        file, curve.organ, off, allowed));
      try
      {
        const tracking::PixelPoints spline = tracking::spline_outline(runner::to_pixels(series.geometry, curve.points),
                                                                      click_spacing / series.geometry.spacing[0]);
        contours.push_back({curve.organ, runner::to_space(series.geometry, spline),
                            dataset::Integers::Zero(spline.rows())}); // region wall: a border everywhere
      }
      catch (const std::invalid_argument &problem)
      {
        throw InputError(fmt::format("'{}': the curve of {}: {}", file, curve.organ, problem.what()));
      }
    }
  return contours;
}

void write_results(const dataset::ImageSeries &series, const runner::TrackedSeries &tracked,
                   const std::filesystem::path &out)
{
  std::filesystem::create_directories(out / "outlines");
  std::vector<report::OverlayFrame> overlay;
  const std::size_t n = tracked.frames.size();
  for (std::size_t frame = 0; frame < n; ++frame)
  {
    std::vector<ClosedCurve> curves;
    for (std::size_t c = 0; c < tracked.rest.size(); ++c)
      curves.push_back({tracked.rest[c].organ, tracked.frames[frame][c].points});
    dataset::write_text_file(out / "outlines" / fmt::format("frame_{:04}.mrk.json", frame), curves_text(curves));
    if (frame == 0 || frame == (n - 1) / 3 || frame == 2 * (n - 1) / 3 || frame == n - 1)
    {
      report::OverlayFrame &shown = overlay.emplace_back();
      shown.frame = static_cast<int>(frame);
      for (const ClosedCurve &curve : curves)
        shown.outlines.push_back({curve.organ, curve.points, false});
    }
  }
  dataset::write_text_file(out / "tracked_points.csv", runner::tracked_point_csv(tracked));
  report::write_overlay(series, overlay, out / "tracked_frames.png");
}

/// A user's own images: no truth, no case.
void track_own(const Arguments &given)
{
  if (!given.dicom.empty() && !given.nrrd.empty())
    throw InputError("--dicom and --nrrd are both given; give the images once");
  if (given.contours.empty())
    throw InputError("--contours is missing; give the outlines in the first frame as .mrk.json closed curves");
  if (given.request.all)
    throw InputError(
        "--all compares trackers with the truth, which your own images do not have; choose one with --tracker");
  Progress progress("track");
  const dataset::ImageSeries series = observation::read_image_series(given.dicom.empty() ? given.nrrd : given.dicom);
  runner::TrackOptions options{.tracker = given.request.tracker, .progress = progress.callback()};
  if (given.request.uterus_border)
    options.flow_only.clear();
  const runner::TrackedSeries tracked = runner::track(series, drawn_contours(series, given.contours), options);
  write_results(series, tracked, given.out);
  progress.finish(fmt::format("{} frames, {:.0f} frames a second", tracked.frames.size(), 1000 / tracked.processor_ms));
  fmt::print("outlines: {}\npicture: {}\n", (std::filesystem::path(given.out) / "outlines").string(),
             (std::filesystem::path(given.out) / "tracked_frames.png").string());
}

void run_track(const Arguments &given, const std::string &command_line)
{
  const bool is_own = !given.dicom.empty() || !given.nrrd.empty();
  if (is_own == !given.directory.empty())
    throw InputError("track: give either a result directory DIR, or your own images with --dicom or --nrrd");
  if (is_own)
    return track_own(given);
  if (!given.contours.empty())
    throw InputError("--contours goes with --dicom or --nrrd; a result directory brings its own outlines");
  ResultDirectory directory(given.directory, command_line, ResultDirectory::Missing::refuse);
  make_tracked(directory, given.request);
  print_contour_table(directory);
}
} // namespace

void add_track_command(CLI::App &program, Invocation &invocation)
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App *command = program.add_subcommand(
      "track", "Follow the organs' outlines through dynamic MR images: tracked.h5, contour_errors.csv");
  command->add_option("DIR", arguments->directory, "Result directory with images/dyn.nrrd");
  command->add_option("--tracker", arguments->request.tracker, "Whose outlines are kept; bezier is the paper's")
      ->check(CLI::IsMember(tracking::tracker_names()))
      ->capture_default_str();
  command->add_flag("--all", arguments->request.all, "Compare every tracker with the truth, not the chosen one alone");
  command->add_flag("--uterus-border", arguments->request.uterus_border,
                    "Look for the uterus' border too; the paper follows its optical flow alone");
  command->add_option("--dicom", arguments->dicom, "Your own images: a folder with one dynamic DICOM MR series");
  command->add_option("--nrrd", arguments->nrrd, "Your own images: an NRRD file of one plane over time");
  command->add_option("--contours", arguments->contours,
                      "Outlines in the first frame: closed curves of 3D Slicer (.mrk.json), named bladder, vagina, "
                      "uterus, rectum; one file or several");
  command->add_option("--out", arguments->out, "Folder for the results of your own images")->capture_default_str();
  command->footer(
      "Examples:\n  pelvireg track out/t005\n  pelvireg track out/t005 --all\n"
      "  pelvireg track --dicom series/ --contours bladder.mrk.json --contours rectum.mrk.json --out tracked\n"
      "  pelvireg track --nrrd dynamic.nrrd --contours organs.mrk.json");
  command->callback(
      [&invocation, arguments]
      { invocation.action = [&invocation, arguments] { run_track(*arguments, invocation.command_line); }; });
}
} // namespace pelvireg::cli
