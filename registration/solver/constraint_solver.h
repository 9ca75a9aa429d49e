// Multipliers of one step: (W + C) lambda = delta - H x_free, the last rows being contacts.
#pragma once

#include "registration/solver/contact_sweeps.h"

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// Direct solution of bilateral rows, which are eliminated from the contacts; projected Gauss-Seidel on what is left of
/// these. Redundant and antagonist rows make W singular; a compliance on every row, given or at least
/// `least_relative_compliance` of W's mean diagonal, keeps W + C positive definite, so that such rows share the gap
/// instead of blowing up.
class ConstraintSolver
{
public:
  static constexpr double least_relative_compliance = 1e-10;

  /// Holds OpenBLAS to one thread, for the whole process: its teams allocate at every call, and sums that depend on
  /// their size would not be the same for every number of threads.
  ConstraintSolver();

  /// Set memory aside.
  void reserve(int n_bilateral, int n_contact_rows);

  /// Start a step with n rows: W = 0. The rows from `n_bilateral` on are contacts of `rows_per_contact` (1, or 3 with
  /// friction) rows each.
  void reset(int n_rows, int n_bilateral, int rows_per_contact = 1, double friction_coefficient = 0);
  /// Bilateral rows alone.
  void reset(int n_rows) { reset(n_rows, n_rows); }
  /// Add one body's part of W (lower triangle) over the given rows, which ascend.
  void add_compliance(const std::vector<int> &rows, const Eigen::Ref<const Eigen::MatrixXd> &lower);
  /// What the row must still close after the free motion, mm, and its compliance, mm/N.
  void set_row(int row, double gap, double compliance);
  /// Force of a contact row to start from, N; 0 when not given.
  void guess(int row, double force) { multipliers_[row] = force; }

  /// Cholesky of the bilateral rows, sweeps over the contacts, then refinement of the bilateral rows until none of
  /// their equations is open by more than limits.tolerance_mm or limits.max_sweeps are used. False when the system is
  /// not positive definite or not finite; contacts that have not settled after max_sweeps are told by
  /// contact_residual().
  bool solve(const SweepLimits &limits);

  /// N; at least as many as rows, zero behind them.
  const Eigen::VectorXd &multipliers() const { return multipliers_; }
  int sweeps() const { return sweeps_; } ///< over the contacts; of the refinement when there are none
  const ContactResidual &contact_residual() const { return contact_residual_; }

private:
  bool factorise_bilateral();
  void solve_contacts(const SweepLimits &limits);
  bool solve_bilateral(const SweepLimits &limits);
  double &at(int row, int column) { return system_[static_cast<std::size_t>(column) * n_rows_ + row]; }

  int n_rows_ = 0, n_bilateral_ = 0;
  ContactProblem contact_problem_;
  ContactSweeps contact_sweeps_;
  ContactResidual contact_residual_;
  // Buffers only grow, so that steps with other numbers of contacts do not allocate.
  std::vector<double> system_;    ///< lower triangle, column-major, n_rows square
  std::vector<double> factor_;    ///< of the bilateral block
  std::vector<double> coupling_;  ///< contact rows x bilateral columns, then times L^-T
  std::vector<double> condensed_; ///< S
  std::vector<double> condensed_gaps_, right_side_;
  std::vector<double> gaps_, compliances_;
  Eigen::VectorXd multipliers_;
  int sweeps_ = 0;
};
} // namespace pelvireg::registration
