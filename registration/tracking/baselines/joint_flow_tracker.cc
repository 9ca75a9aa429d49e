#include "registration/tracking/baselines/joint_flow_tracker.h"

#include "registration/tracking/baselines/static_tracker.h"
#include "registration/tracking/border_fit.h"

namespace pelvireg::tracking
{
void JointFlowTracker::do_start(const Image &first, const std::vector<InitialOutline> &outlines)
{
  scale_ = std::make_unique<FlowScale>(first);
  last_ = (*scale_)(GreyImage(first, options_.smoothing).pixels());
  tracked_ = as_given(outlines);
  fits_.clear();
  curves_.clear();
  for (const InitialOutline &outline : outlines)
  {
    fits_.push_back(fit_bezier(outline, options_));
    curves_.push_back(fits_.back().curve);
  }
}

TrackedFrame JointFlowTracker::do_update(const Image &frame)
{
  FlowFrame now = (*scale_)(GreyImage(frame, options_.smoothing).pixels());
  for (std::size_t organ = 0; organ < fits_.size(); ++organ)
  {
    std::vector<Eigen::Vector2d> joints = curves_[organ].joints;
    const std::vector<FlowPoint> moved = last_.lucas_kanade(now, joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (moved[i].found)
        joints[i] = moved[i].position;
    curves_[organ] = carry(curves_[organ], joints);
    tracked_.outlines[organ].points = fits_[organ].points_on(curves_[organ]);
  }
  last_ = std::move(now);
  return tracked_;
}
} // namespace pelvireg::tracking
