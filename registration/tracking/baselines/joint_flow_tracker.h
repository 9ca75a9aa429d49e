// Baseline: Lucas-Kanade on the joints alone.
#pragma once

#include "registration/tracking/bezier_outline.h"
#include "registration/tracking/optical_flow.h"

namespace pelvireg::tracking
{
/// The joints of the Bezier tracker, moved from frame to frame by pyramidal Lucas-Kanade; inner control points are
/// carried with their chords. A joint whose flow is not found stays; nothing else is looked at.
class JointFlowTracker : public OutlineTracker
{
public:
  explicit JointFlowTracker(const Options &options) : options_(options) {}

private:
  void do_start(const Image &first, const std::vector<InitialOutline> &outlines) override;
  TrackedFrame do_update(const Image &frame) override;

  Options options_;
  std::unique_ptr<FlowScale> scale_;
  FlowFrame last_;
  std::vector<BezierFit> fits_;
  std::vector<BezierCurve> curves_;
  TrackedFrame tracked_;
};
} // namespace pelvireg::tracking
