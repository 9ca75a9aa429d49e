#include "registration/tracking/outline_tracker.h"

#include "registration/tracking/baselines/dense_flow_tracker.h"
#include "registration/tracking/baselines/joint_flow_tracker.h"
#include "registration/tracking/baselines/snake_tracker.h"
#include "registration/tracking/baselines/static_tracker.h"
#include "registration/tracking/bezier_tracker.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace pelvireg::tracking
{
namespace
{
template <class... Parts> void require(bool condition, const Parts &...parts)
{
  if (condition)
    return;
  std::ostringstream sentence;
  sentence.precision(6);
  (sentence << ... << parts);
  throw std::invalid_argument(sentence.str());
}

void check_image(const Image &image, int number)
{
  require(image.columns >= 16 && image.rows >= 16, "frame ", number, ": has ", image.columns, " x ", image.rows,
          " pixels, at least 16 x 16 are needed; give whole images");
  const std::size_t n = static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows);
  require(image.pixels.size() == n, "frame ", number, ": has ", image.pixels.size(), " values for ", image.columns,
          " x ", image.rows, " pixels, must be ", n, "; only grey images can be tracked");
  for (std::size_t i = 0; i < n; ++i)
    require(std::isfinite(image.pixels[i]), "frame ", number, ": the pixel in column ",
            i % static_cast<std::size_t>(image.columns), ", row ", i / static_cast<std::size_t>(image.columns),
            " is not finite; repair or leave out the frame");
}

void check_outline(const InitialOutline &outline, const Image &image)
{
  const Eigen::Index n = outline.points.rows();
  require(n >= 3, "outline of ", outline.organ, ": has ", n, " points, at least 3 are needed; draw it closed");
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double x = outline.points(i, 0), y = outline.points(i, 1);
    require(std::isfinite(x) && std::isfinite(y), "outline of ", outline.organ, ": point ", i,
            " (0-based) is not finite; draw it again");
    require(x >= -0.5 && y >= -0.5 && x <= image.columns - 0.5 && y <= image.rows - 0.5, "outline of ", outline.organ,
            ": point ", i, " (0-based) lies at column ", x, ", row ", y, ", outside the image of ", image.columns,
            " x ", image.rows, " pixels; draw the outline in the images that are tracked");
  }
  require((outline.points.rowwise() - outline.points.row(0)).rowwise().norm().maxCoeff() > 1, "outline of ",
          outline.organ, ": is smaller than a pixel; draw it around the organ");
  require(outline.has_border.empty() || static_cast<Eigen::Index>(outline.has_border.size()) == n, "outline of ",
          outline.organ, ": has ", outline.has_border.size(), " border flags for ", n,
          " segments, must be one each or none");
}
template <class Tracker> std::unique_ptr<OutlineTracker> make(const Options &options)
{
  return std::make_unique<Tracker>(options);
}

struct TrackerKind
{
  const char *name;
  std::unique_ptr<OutlineTracker> (*make)(const Options &);
};

constexpr TrackerKind tracker_kinds[] = {{"bezier", make<BezierTracker>},
                                         {"static", make<StaticTracker>},
                                         {"lk_joints", make<JointFlowTracker>},
                                         {"dense_flow", make<DenseFlowTracker>},
                                         {"snake", make<SnakeTracker>}};
} // namespace

std::vector<std::string> Options::violations() const
{
  std::vector<std::string> problems;
  const auto check = [&](bool is_right, const std::string &name, double value, const std::string &allowed)
  {
    if (!is_right)
      problems.push_back("tracking: " + name + " is " + std::to_string(value) + ", must lie in " + allowed);
  };
  check(joint_spacing >= 4 && joint_spacing <= 40, "joint_spacing", joint_spacing, "[4, 40] px");
  check(corner_curvature > 0 && corner_curvature <= 2, "corner_curvature", corner_curvature, "(0, 2] 1/px");
  check(smoothing >= 0 && smoothing <= 5, "smoothing", smoothing, "[0, 5] px");
  check(lost_below > 0 && lost_below < 1, "lost_below", lost_below, "(0, 1)");
  return problems;
}

void OutlineTracker::start(const Image &first, const std::vector<InitialOutline> &outlines)
{
  check_image(first, 0);
  require(!outlines.empty(), "tracking: no outline is given, at least one is needed");
  for (const InitialOutline &outline : outlines)
    check_outline(outline, first);
  do_start(first, outlines);
  columns_ = first.columns;
  rows_ = first.rows;
  n_frames_ = 1;
}

TrackedFrame OutlineTracker::update(const Image &frame)
{
  if (n_frames_ == 0)
    throw std::logic_error("tracking: update() before start()");
  check_image(frame, n_frames_);
  require(frame.columns == columns_ && frame.rows == rows_, "frame ", n_frames_, ": has ", frame.columns, " x ",
          frame.rows, " pixels, must be ", columns_, " x ", rows_, " as the first frame; give one series");
  ++n_frames_;
  return do_update(frame);
}

const std::vector<std::string> &tracker_names()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const TrackerKind &kind : tracker_kinds)
      all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

std::unique_ptr<OutlineTracker> make_tracker(const std::string &name, const Options &options)
{
  const std::vector<std::string> problems = options.violations();
  if (!problems.empty())
    throw std::invalid_argument(problems.front());
  std::string allowed;
  for (const TrackerKind &kind : tracker_kinds)
  {
    if (name == kind.name)
      return kind.make(options);
    allowed += std::string(allowed.empty() ? "" : ", ") + kind.name;
  }
  throw std::invalid_argument("unknown tracker '" + name + "'; one of " + allowed + " is allowed");
}
} // namespace pelvireg::tracking
