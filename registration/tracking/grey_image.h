// A frame as trackers look at it: smoothed, sampled between pixels.
#pragma once

#include "registration/tracking/outline_tracker.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::tracking
{
/// A single-channel image; values beyond its edge are those of the edge.
class GreyImage
{
public:
  GreyImage() = default;
  /// Seen through a Gaussian of standard deviation `sigma` px (0: as it is).
  GreyImage(const Image &image, double sigma);

  int columns() const { return image_.columns; }
  int rows() const { return image_.rows; }
  const Image &pixels() const { return image_; }

  bool contains(const Eigen::Vector2d &point) const
  {
    return point.x() >= 0 && point.y() >= 0 && point.x() <= image_.columns - 1 && point.y() <= image_.rows - 1;
  }

  /// Bilinear.
  double operator()(const Eigen::Vector2d &point) const
  {
    const double x = std::clamp(point.x(), 0.0, image_.columns - 1.001);
    const double y = std::clamp(point.y(), 0.0, image_.rows - 1.001);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double fx = x - column, fy = y - row;
    const float *pixel = image_.pixels.data() + static_cast<std::ptrdiff_t>(row) * image_.columns + column;
    const float *below = pixel + image_.columns;
    return (1 - fy) * ((1 - fx) * pixel[0] + fx * pixel[1]) + fy * ((1 - fx) * below[0] + fx * below[1]);
  }

  /// By central differences over one pixel.
  Eigen::Vector2d gradient(const Eigen::Vector2d &point) const
  {
    const Eigen::Vector2d right(0.5, 0), down(0, 0.5);
    return {(*this)(point + right) - (*this)(point - right), (*this)(point + down) - (*this)(point - down)};
  }

private:
  Image image_;
};

/// Standard deviation of the noise, from one frame: mean of the absolute second mixed difference (Immerkaer 1996),
/// which planes and edges along rows or columns do not reach.
double noise_of(const Image &image);
/// How well two places look alike, 1 … 0, from the mean squared difference of their values: 1 up to what noise (its
/// standard deviation in either) and a tolerated change of signal explain.
double agreement_of(double squared_difference, double noise, double tolerance);
/// The value that `share` (0 … 1) of the pixels do not exceed.
double percentile_of(const Image &image, double share);
/// The 99th minus the 1st percentile.
double contrast_of(const Image &image);
} // namespace pelvireg::tracking
