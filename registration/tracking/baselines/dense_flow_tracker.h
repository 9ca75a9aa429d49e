// Baseline: every point of the outline goes where dense optical flow leads it.
#pragma once

#include "registration/tracking/optical_flow.h"

namespace pelvireg::tracking
{
/// Dense inverse search from each frame to the next, on the smoothed frames; errors add up.
class DenseFlowTracker : public OutlineTracker
{
public:
  explicit DenseFlowTracker(const Options &options) : options_(options) {}

private:
  void do_start(const Image &first, const std::vector<InitialOutline> &outlines) override;
  TrackedFrame do_update(const Image &frame) override;

  Options options_;
  std::unique_ptr<FlowScale> scale_;
  FlowFrame last_;
  TrackedFrame tracked_;
};
} // namespace pelvireg::tracking
