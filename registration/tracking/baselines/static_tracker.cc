#include "registration/tracking/baselines/static_tracker.h"

namespace pelvireg::tracking
{
TrackedFrame as_given(const std::vector<InitialOutline> &outlines)
{
  TrackedFrame frame;
  for (const InitialOutline &outline : outlines)
  {
    const Eigen::Index n = outline.points.rows();
    frame.outlines.push_back(
        {outline.organ, outline.points, Eigen::VectorXd::Ones(n), std::vector<char>(static_cast<std::size_t>(n), 0)});
  }
  return frame;
}

void StaticTracker::do_start(const Image &, const std::vector<InitialOutline> &outlines)
{
  rest_ = as_given(outlines);
}

TrackedFrame StaticTracker::do_update(const Image &)
{
  return rest_;
}
} // namespace pelvireg::tracking
