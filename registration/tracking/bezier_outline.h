// An outline as the paper's composite Bezier curve (section 4, figure 3): cubic segments between joints, which are
// material points.
#pragma once

#include "registration/tracking/outline_tracker.h"

#include <array>

namespace pelvireg::tracking
{
/// Values of the four cubic Bernstein polynomials at t.
Eigen::Vector4d bernstein(double t);

/// A closed chain of cubic segments; segment i runs from joint i to joint i + 1.
struct BezierCurve
{
  std::vector<Eigen::Vector2d> joints;
  std::vector<std::array<Eigen::Vector2d, 2>> inner; ///< control points p1 and p2 of each segment

  std::size_t n_segments() const { return joints.size(); }
  const Eigen::Vector2d &next_joint(std::size_t segment) const { return joints[(segment + 1) % joints.size()]; }
  Eigen::Vector2d position(std::size_t segment, double t) const;
  /// Unit tangent; that of the chord where the derivative vanishes.
  Eigen::Vector2d tangent(std::size_t segment, double t) const;
  /// Unit: the tangent turned from +x towards -y, which is outward for a curve that runs from +x towards +y.
  Eigen::Vector2d normal(std::size_t segment, double t) const;
};

/// Where on the chain a material point lies.
struct BezierPlace
{
  std::size_t segment = 0;
  double t = 0;
};

/// The outline at rest.
struct BezierFit
{
  BezierCurve curve;               ///< runs from +x towards +y (its normals point outward)
  std::vector<char> is_corner;     ///< one a joint: a maximum of curvature
  std::vector<char> has_border;    ///< one a segment: its larger part shows one
  std::vector<BezierPlace> places; ///< of the outline's points
  /// Of the outline's points, along tangent and normal at their places: what the fit leaves, so that the first frame is
  /// met exactly.
  std::vector<Eigen::Vector2d> remainder;

  /// The outline's points when the curve has moved: n x 2.
  PixelPoints points_on(const BezierCurve &moved) const;
};

/// Fits a closed B-spline with a control point every 4 px (at least 8), takes its corners as joints and fills up until
/// no two are farther apart than Options::joint_spacing.
BezierFit fit_bezier(const InitialOutline &outline, const Options &options);
} // namespace pelvireg::tracking
