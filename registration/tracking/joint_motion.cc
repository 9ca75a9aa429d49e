#include "registration/tracking/joint_motion.h"

#include <Eigen/Dense>

#include <cmath>

namespace pelvireg::tracking
{
namespace
{
using Eigen::Vector2d;

constexpr double reference_spacing = 8; // px
constexpr int n_reweightings = 3;
constexpr double cauchy = 2.5; // standard deviations at which a measurement has half its weight

/// Adds weight * |(x_b - x_a) - difference|^2 to a system in x.
void add_difference(Eigen::MatrixXd &matrix, Eigen::VectorXd &right, std::size_t joint_a, std::size_t joint_b,
                    const Vector2d &difference, double weight)
{
  const Eigen::Index a = 2 * static_cast<Eigen::Index>(joint_a), b = 2 * static_cast<Eigen::Index>(joint_b);
  for (Eigen::Index k = 0; k < 2; ++k)
  {
    matrix(a + k, a + k) += weight;
    matrix(b + k, b + k) += weight;
    matrix(a + k, b + k) -= weight;
    matrix(b + k, a + k) -= weight;
    right[a + k] -= weight * difference[k];
    right[b + k] += weight * difference[k];
  }
}
/// The similarity that carries `before` to what was measured best: its linear part, the identity where little was.
Eigen::Matrix2d mean_step(const std::vector<Vector2d> &before, const std::vector<JointMeasurement> &measured,
                          const std::vector<double> &weight)
{
  Vector2d centre = Vector2d::Zero();
  for (const Vector2d &joint : before)
    centre += joint / static_cast<double>(before.size());
  Eigen::Matrix4d matrix = Eigen::Vector4d(1, 1, 1e-6, 1e-6).asDiagonal(); // turn and stretch (a, b), shift
  Eigen::Vector4d right(1, 0, 0, 0);
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const Vector2d from = before[i] - centre;
    Eigen::Matrix<double, 2, 4> map;
    map << from.x(), -from.y(), 1, 0, from.y(), from.x(), 0, 1;
    matrix += weight[i] * map.transpose() * measured[i].precision * map;
    right += weight[i] * map.transpose() * measured[i].precision * (measured[i].position - centre);
  }
  const Eigen::Vector4d solution = matrix.ldlt().solve(right);
  return Eigen::Matrix2d{{solution[0], -solution[1]}, {solution[1], solution[0]}};
}

/// What does not depend on the measurements: shape since rest, and where nothing is seen, rest.
struct Prior
{
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

Prior prior_of(const std::vector<Vector2d> &rest, const std::vector<Vector2d> &before,
               const std::vector<JointMeasurement> &measured, const Eigen::Matrix2d &step, const JointPriors &priors)
{
  const Eigen::Index size = 2 * static_cast<Eigen::Index>(rest.size());
  const Eigen::Matrix2d mean = mean_deformation(rest, before);
  Prior prior{1e-6 * Eigen::MatrixXd::Identity(size, size), Eigen::VectorXd(size)};
  for (std::size_t i = 0; i < rest.size(); ++i)
    prior.right.segment<2>(2 * static_cast<Eigen::Index>(i)) = 1e-6 * before[i];
  for (std::size_t i = 0; i < rest.size(); ++i)
  {
    const std::size_t next = (i + 1) % rest.size();
    const Vector2d edge = rest[next] - rest[i];
    const double length = std::max(edge.norm(), 1e-6);
    const bool was_seen = measured[i].was_seen && measured[next].was_seen;
    const double difference =
        (was_seen ? priors.step_difference : priors.unseen_step_difference) * std::sqrt(length / reference_spacing);
    add_difference(prior.matrix, prior.right, i, next, step * (before[next] - before[i]),
                   1 / (difference * difference));
    const double stretch = priors.stretch * length;
    add_difference(prior.matrix, prior.right, i, next, step * (mean * edge), 1 / (stretch * stretch));
  }
  return prior;
}
} // namespace

Eigen::Matrix2d mean_deformation(const std::vector<Vector2d> &from, const std::vector<Vector2d> &to)
{
  Vector2d centre_from = Vector2d::Zero(), centre_to = Vector2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    centre_from += from[i];
    centre_to += to[i];
  }
  centre_from /= static_cast<double>(from.size());
  centre_to /= static_cast<double>(from.size());
  Eigen::Matrix2d cross = Eigen::Matrix2d::Zero(), square = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    cross += (to[i] - centre_to) * (from[i] - centre_from).transpose();
    square += (from[i] - centre_from) * (from[i] - centre_from).transpose();
  }
  // An outline without width is taken as unstretched across.
  const double slight = 1e-6 * square.trace();
  return (cross + slight * Eigen::Matrix2d::Identity()) * (square + slight * Eigen::Matrix2d::Identity()).inverse();
}

std::vector<Vector2d> move_joints(const std::vector<Vector2d> &rest, const std::vector<Vector2d> &before,
                                  const std::vector<JointMeasurement> &measured, const JointPriors &priors)
{
  const std::size_t n = rest.size();
  std::vector<double> weight(n, 1);
  std::vector<Vector2d> joints = before;
  for (int pass = 0; pass < n_reweightings; ++pass)
  {
    auto [matrix, right] = prior_of(rest, before, measured, mean_step(before, measured, weight), priors);
    for (std::size_t i = 0; i < n; ++i)
    {
      const Eigen::Index at = 2 * static_cast<Eigen::Index>(i);
      matrix.block<2, 2>(at, at) += weight[i] * measured[i].precision;
      right.segment<2>(at) += weight[i] * measured[i].precision * measured[i].position;
    }
    const Eigen::VectorXd solution = matrix.llt().solve(right);
    for (std::size_t i = 0; i < n; ++i)
    {
      joints[i] = solution.segment<2>(2 * static_cast<Eigen::Index>(i));
      const Vector2d miss = joints[i] - measured[i].position;
      weight[i] = 1 / (1 + miss.dot(measured[i].precision * miss) / (cauchy * cauchy));
    }
  }
  return joints;
}
} // namespace pelvireg::tracking
