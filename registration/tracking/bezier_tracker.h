// The tracker of the paper's section 4.
#pragma once

#include "registration/tracking/border_fit.h"
#include "registration/tracking/joint_motion.h"
#include "registration/tracking/optical_flow.h"
#include "registration/tracking/patch_match.h"

#include <memory>

namespace pelvireg::tracking
{
/// Follows each outline as a composite Bezier curve. In every frame:
///   1. pyramidal Lucas-Kanade predicts the joints from the frame before, there and back;
///   2. each joint is matched to its surroundings in the *first* frame, so that nothing drifts; a joint that does not
///      agree with them is lost and looked for again in every later frame;
///   3. joints move together: as measured, but not against their neighbours (move_joints);
///   4. joints move along their normals and inner control points across their segments, to where the profiles along the
///      normals are those of the first frame (BorderFit). Outlines that follow flow alone leave this out.
class BezierTracker : public OutlineTracker
{
public:
  explicit BezierTracker(const Options &options) : options_(options) {}

private:
  struct Joint
  {
    ReferencePatch patch;
    double agreement = 1; ///< with the first frame, 0 … 1
    bool is_lost = false;
  };
  struct Organ
  {
    std::string name;
    BezierFit fit;
    std::unique_ptr<BorderFit> border;
    std::vector<Joint> joints;
    BezierCurve curve; ///< in the last frame
  };

  void do_start(const Image &first, const std::vector<InitialOutline> &outlines) override;
  TrackedFrame do_update(const Image &frame) override;

  Organ make_organ(const InitialOutline &outline) const;
  /// One joint in one frame.
  struct Sighting
  {
    JointMeasurement measurement;
    double agreement = 0;
    bool is_lost = true;
  };
  Sighting look_for(const Organ &organ, std::size_t index, const Eigen::Vector2d &start, const Eigen::Matrix2d &turn,
                    const GreyImage &image) const;
  /// Where the joints go; `flow` leads each from the last frame. Notes which are lost.
  std::vector<Eigen::Vector2d> follow_joints(Organ &organ, const FlowPoint *flow, const GreyImage &image,
                                             TrackedFrame &frame) const;
  TrackedOutline outline_of(const Organ &organ, const GreyImage &image) const;

  Options options_;
  double noise_ = 0, tolerance_ = 0;
  GreyImage first_;
  std::unique_ptr<FlowScale> scale_;
  FlowFrame last_;
  std::vector<Organ> organs_;
};
} // namespace pelvireg::tracking
