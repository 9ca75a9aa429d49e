#include "registration/tracking/baselines/dense_flow_tracker.h"

#include "registration/tracking/baselines/static_tracker.h"

namespace pelvireg::tracking
{
void DenseFlowTracker::do_start(const Image &first, const std::vector<InitialOutline> &outlines)
{
  scale_ = std::make_unique<FlowScale>(first);
  last_ = (*scale_)(GreyImage(first, options_.smoothing).pixels());
  tracked_ = as_given(outlines);
}

TrackedFrame DenseFlowTracker::do_update(const Image &frame)
{
  FlowFrame now = (*scale_)(GreyImage(frame, options_.smoothing).pixels());
  std::vector<Eigen::Vector2d> points;
  for (const TrackedOutline &outline : tracked_.outlines)
    for (const auto &point : outline.points.rowwise())
      points.push_back(point.transpose());
  std::size_t next = 0;
  const std::vector<Eigen::Vector2d> moved = last_.dense_inverse_search(now, points);
  for (TrackedOutline &outline : tracked_.outlines)
    for (auto point : outline.points.rowwise())
      point = moved[next++].transpose();
  last_ = std::move(now);
  return tracked_;
}
} // namespace pelvireg::tracking
