// The border of an organ in the image: compared, along the outline's normals, with what the first frame shows there.
#pragma once

#include "registration/tracking/bezier_outline.h"
#include "registration/tracking/grey_image.h"

#include <array>

namespace pelvireg::tracking
{
/// How far the border fit may leave what it is given: standard deviations, px.
struct BorderPriors
{
  double joint = 1.0;      ///< of a joint along its normal, from where flow put it
  double inner = 0.5;      ///< of an inner control point, across its segment, from its predicted place
  double difference = 0.5; ///< between the moves of two joints 8 px apart
  double smooth_bend = 0.1, corner_bend = 0.4; ///< rad: change since rest of the angle at a joint
};

/// Energy of one outline: profiles along the normals from 6 px inside to 3 px outside, a sample every 1.5 px of
/// outline.
class BorderFit
{
public:
  /// @param noise     standard deviation of the noise in `first`, as it is seen (smoothed)
  /// @param tolerance change of a tissue's signal that still counts as the same, in the image's unit
  BorderFit(const GreyImage &first, const BezierFit &fit, double noise, double tolerance);

  /// Moves joints along their normals and inner control points across their segments (paper, figure 3) to the minimum
  /// of profile differences, bending, and deviation from `predicted`. Segments without border follow their neighbours.
  /// Gives `predicted` back when the minimum lies more than 4 px away.
  BezierCurve adjust(const GreyImage &image, const BezierCurve &predicted, const BorderPriors &priors) const;

  /// How well the profile at a place agrees with the first frame's: 0 … 1.
  double agreement(const GreyImage &image, const BezierCurve &curve, const BezierPlace &place) const;

private:
  static constexpr int n_taps = 10, first_tap = -6;
  struct Sample
  {
    std::size_t segment = 0;
    double t = 0;
    std::array<double, n_taps> profile{};
  };
  struct Shift ///< along a sample's normal, as its profile asks for
  {
    double value = 0;     ///< px
    double precision = 0; ///< 1/px^2
  };
  Shift wanted_shift(const GreyImage &image, const BezierCurve &curve, const Sample &sample) const;
  double squared_difference(const GreyImage &image, const BezierCurve &curve, const Sample &sample) const;

  const BezierFit &fit_;
  double noise_ = 0, tolerance_ = 0;
  std::vector<Sample> samples_;
  std::vector<std::size_t> first_sample_; ///< of each segment, and the number of all
  std::vector<double> rest_angle_;        ///< rad, of each joint
};

/// The inner control points of `from`, carried along when its joints move: turned and scaled with their chord.
BezierCurve carry(const BezierCurve &from, const std::vector<Eigen::Vector2d> &joints);
/// Likewise: along the chords as at rest, across them as in the last frame, so that inner control points wander neither
/// along the outline nor, where nothing is seen of them, for long across it.
BezierCurve predict(const BezierCurve &rest, const BezierCurve &last, const std::vector<Eigen::Vector2d> &joints);
} // namespace pelvireg::tracking
