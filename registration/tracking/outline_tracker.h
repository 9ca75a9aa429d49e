// Outlines of organs followed through a dynamic image series (paper: section 4). Plain arrays in and out.
//
// Coordinates are pixels of the image plane: x = column, y = row, (0, 0) the centre of the first pixel. A tracker knows
// nothing of space, of files, or of what the organs are.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace pelvireg::tracking
{
/// n x 2: column and row, pixels.
using PixelPoints = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// One grey frame.
struct Image
{
  int columns = 0, rows = 0;
  std::vector<float> pixels; ///< row by row, rows * columns values, finite
};

/// The outline of one organ in the first frame.
struct InitialOutline
{
  std::string organ;
  /// n x 2, n >= 3: closed (the last point joins the first), in order, either way round, inside the image. Every point
  /// stands for the material point that lies there; a few clicks become such points with spline_outline().
  PixelPoints points;
  /// One a segment (i to i + 1): 0 where the image shows no border, as at the open end of a tube or where two organs
  /// have grown together. Empty: a border everywhere.
  std::vector<char> has_border;
  /// The organ has too little contrast for its border to be looked for: it follows the optical flow alone (the paper's
  /// uterus).
  bool flow_only = false;
};

struct TrackedOutline
{
  std::string organ;
  PixelPoints points; ///< n x 2, the material points of InitialOutline::points in its order
  /// n, 0 … 1: how well the image around the point agrees with the first frame. 1 for trackers that do not look.
  Eigen::VectorXd confidence;
  std::vector<char> is_lost; ///< n: 1 where confidence is below Options::lost_below; the position is then a guess
};

struct TrackedFrame
{
  std::vector<TrackedOutline> outlines; ///< in the order of start()
  int n_lost_joints = 0;                ///< feature points that the image does not confirm in this frame
  int n_reacquired_joints = 0;          ///< of those lost in the frame before: found again in this one
};

struct Options
{
  double joint_spacing = 8;       ///< px, largest distance of two joints along the outline
  double corner_curvature = 0.12; ///< 1/px: a maximum of curvature above this is a corner and becomes a joint
  double smoothing = 0.7;         ///< px, standard deviation of the Gaussian that every frame is seen through
  double lost_below = 0.35;       ///< confidence below which a point counts as lost, in (0, 1)

  /// What is wrong, as sentences; empty when nothing is.
  std::vector<std::string> violations() const;
};

/// Follows closed outlines from frame to frame. Deterministic: one thread, the same frames give the same bytes.
class OutlineTracker
{
public:
  virtual ~OutlineTracker() = default;

  /// The first frame and the outlines in it. Throws std::invalid_argument, naming what, where and the remedy, for an
  /// image without pixels or with a value that is not finite, for an outline with fewer than three points, with a point
  /// outside the image or not finite, with repeated points alone, or with the wrong number of flags.
  void start(const Image &first, const std::vector<InitialOutline> &outlines);

  /// Where the outlines lie in the next frame. Throws std::invalid_argument for a frame of another size or with a value
  /// that is not finite, which leaves the tracker as it was, and std::logic_error before start().
  TrackedFrame update(const Image &frame);

protected:
  virtual void do_start(const Image &first, const std::vector<InitialOutline> &outlines) = 0;
  virtual TrackedFrame do_update(const Image &frame) = 0;

private:
  int columns_ = 0, rows_ = 0;
  int n_frames_ = 0;
};

/// "bezier" (the paper's), then what it must beat: "static", "lk_joints", "dense_flow", "snake".
const std::vector<std::string> &tracker_names();

/// A tracker by name. Throws std::invalid_argument for an unknown name or options out of range.
std::unique_ptr<OutlineTracker> make_tracker(const std::string &name, const Options &options = {});

/// Closed cubic spline through a few points (n x 2, n >= 3), as points `spacing` px apart. The first is the first
/// given. Throws std::invalid_argument for fewer than three points, two equal neighbours or a spacing that is not
/// positive.
PixelPoints spline_outline(const PixelPoints &clicks, double spacing);
} // namespace pelvireg::tracking
