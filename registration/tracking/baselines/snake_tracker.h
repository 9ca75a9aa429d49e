// Baseline: an active contour (Kass, Witkin and Terzopoulos 1988).
#pragma once

#include "registration/tracking/grey_image.h"

namespace pelvireg::tracking
{
/// From the outline of the frame before, a snake of points 2 px apart moves down the energy -|grad I|, of a frame seen
/// through a Gaussian of 1 px, under tension and bending of its deviation from the outline at rest; semi-implicit
/// steps. It knows edges alone: points move along the normal, and nothing tells which tissue an edge belongs to.
class SnakeTracker : public OutlineTracker
{
public:
  explicit SnakeTracker(const Options &) {}

private:
  struct Snake
  {
    PixelPoints rest, points;         ///< m x 2
    Eigen::MatrixXd inverse;          ///< of the semi-implicit step
    std::vector<Eigen::Index> before; ///< of each outline point: the snake's point before it
    Eigen::VectorXd share;            ///< of each outline point: how far to the next
    PixelPoints remainder;            ///< of each outline point, from its place on the resting snake
  };

  void do_start(const Image &first, const std::vector<InitialOutline> &outlines) override;
  TrackedFrame do_update(const Image &frame) override;

  static Snake make_snake(const PixelPoints &outline);

  double slope_ = 1; ///< of a strong edge in the first frame
  std::vector<Snake> snakes_;
  TrackedFrame tracked_;
};
} // namespace pelvireg::tracking
