// Multipliers of one step: (W + C) lambda = delta - H x_free.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// Direct solution of bilateral rows. Redundant and antagonist rows make W singular; a compliance on every row, given
/// or at least `least_relative_compliance` of W's mean diagonal, keeps W + C positive definite, so that such rows share
/// the gap instead of blowing up.
class ConstraintSolver
{
public:
  static constexpr double least_relative_compliance = 1e-10;

  /// Start a step with n rows: W = 0.
  void reset(int n_rows);
  /// Add one body's part of W (lower triangle) over the given rows, which ascend.
  void add_compliance(const std::vector<int> &rows, const Eigen::MatrixXd &lower);
  /// What the row must still close after the free motion, mm, and its compliance, mm/N.
  void set_row(int row, double gap, double compliance);

  /// Cholesky, then refinement until no row's equation is open by more than tolerance_mm or max_sweeps are used.
  /// False when the system is not positive definite or not finite.
  bool solve(double tolerance_mm, int max_sweeps);

  const Eigen::VectorXd &multipliers() const { return multipliers_; } ///< N
  int sweeps() const { return sweeps_; }

private:
  Eigen::MatrixXd system_, factor_;
  Eigen::VectorXd gaps_, compliances_, multipliers_, residual_;
  int sweeps_ = 0;
};
} // namespace pelvireg::registration
