// Baseline: the outline never moves.
#pragma once

#include "registration/tracking/outline_tracker.h"

namespace pelvireg::tracking
{
class StaticTracker : public OutlineTracker
{
public:
  explicit StaticTracker(const Options &) {}

private:
  void do_start(const Image &first, const std::vector<InitialOutline> &outlines) override;
  TrackedFrame do_update(const Image &frame) override;

  TrackedFrame rest_;
};

/// The outlines as they are given, of full confidence.
TrackedFrame as_given(const std::vector<InitialOutline> &outlines);
} // namespace pelvireg::tracking
