// Where the joints of one outline go, from what was seen of each and what their neighbours do.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pelvireg::tracking
{
/// What is known of one joint in a frame.
struct JointMeasurement
{
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  /// Inverse covariance, 1/px^2; zero for a lost joint, one-sided along a straight border.
  Eigen::Matrix2d precision = Eigen::Matrix2d::Zero();
  /// The joint was not lost in the frame before: where it was then is known.
  bool was_seen = true;
};

/// What neighbouring joints may do against each other.
struct JointPriors
{
  double step_difference = 0.15;     ///< px for joints 8 px apart, standard deviation: between two frames,
                                     ///< beside the outline's mean turn and stretch in them
  double unseen_step_difference = 3; ///< the same, for an edge with a joint that was lost
  double stretch = 0.3; ///< standard deviation of an edge's change since rest, in parts of its length, beside
                        ///< the outline's mean deformation: no material point slides along the outline for good
};

/// Positions of closed joints: minimum over all of the squared deviations from measurements, steps that differ between
/// neighbours after the outline's mean step (a similarity) and edges that differ from rest after its mean affine
/// deformation; all in standard deviations. A
/// measurement that neighbours contradict loses weight (Cauchy).
/// @param rest, before  the joints in the first and in the last frame, px
std::vector<Eigen::Vector2d> move_joints(const std::vector<Eigen::Vector2d> &rest,
                                         const std::vector<Eigen::Vector2d> &before,
                                         const std::vector<JointMeasurement> &measured, const JointPriors &priors);

/// The affine map that carries `from` to `to` best: its linear part.
Eigen::Matrix2d mean_deformation(const std::vector<Eigen::Vector2d> &from, const std::vector<Eigen::Vector2d> &to);
} // namespace pelvireg::tracking
