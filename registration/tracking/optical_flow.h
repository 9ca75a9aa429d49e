// Optical flow between two frames.
#pragma once

#include "registration/tracking/grey_image.h"

#include <memory>
#include <vector>

namespace pelvireg::tracking
{
struct FlowPoint
{
  Eigen::Vector2d position = Eigen::Vector2d::Zero(); ///< in the second frame
  double round_trip = 0; ///< px between the start and where the flow back leads from `position`
  bool found = false;
};

/// Frames in the eight bits that the flow algorithms see: one linear scale, set by the first frame.
class FlowFrame
{
public:
  FlowFrame();
  /// `low` becomes 0 and `high` 255.
  FlowFrame(const Image &image, double low, double high);
  ~FlowFrame();
  FlowFrame(FlowFrame &&) noexcept;
  FlowFrame &operator=(FlowFrame &&) noexcept;

  /// Pyramidal Lucas-Kanade (Lucas and Kanade 1981, Bouguet 2001): windows of 13 x 13 px, three levels, there and back.
  std::vector<FlowPoint> lucas_kanade(const FlowFrame &next, const std::vector<Eigen::Vector2d> &points) const;

  /// Dense inverse search (Kroeger et al. 2016), OpenCV's medium preset, read bilinearly at the points: their
  /// positions in the next frame.
  std::vector<Eigen::Vector2d> dense_inverse_search(const FlowFrame &next,
                                                    const std::vector<Eigen::Vector2d> &points) const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The scale of a series: from its first frame, with room for brighter ones.
struct FlowScale
{
  explicit FlowScale(const Image &first);
  FlowFrame operator()(const Image &image) const { return {image, low, high}; }
  double low = 0, high = 1;
};
} // namespace pelvireg::tracking
