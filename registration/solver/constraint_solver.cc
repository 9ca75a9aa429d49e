#include "registration/solver/constraint_solver.h"

#include <Eigen/Dense>

#include <algorithm>

namespace pelvireg::registration
{
void ConstraintSolver::reset(int n_rows)
{
  system_.setZero(n_rows, n_rows);
  gaps_.setZero(n_rows);
  compliances_.setZero(n_rows);
  multipliers_.setZero(n_rows);
  sweeps_ = 0;
}

void ConstraintSolver::add_compliance(const std::vector<int> &rows, const Eigen::MatrixXd &lower)
{
  for (std::size_t l = 0; l < rows.size(); ++l)
    for (std::size_t k = l; k < rows.size(); ++k)
      system_(rows[k], rows[l]) += lower(k, l);
}

void ConstraintSolver::set_row(int row, double gap, double compliance)
{
  gaps_[row] = gap;
  compliances_[row] = compliance;
}

bool ConstraintSolver::solve(double tolerance_mm, int max_sweeps)
{
  if (gaps_.size() == 0)
    return true;
  const double least = least_relative_compliance * system_.diagonal().mean();
  system_.diagonal() += compliances_.cwiseMax(least);
  factor_ = system_;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(factor_);
  if (cholesky.info() != Eigen::Success)
    return false;
  residual_ = gaps_;
  double last_error = residual_.cwiseAbs().maxCoeff();
  for (sweeps_ = 1; sweeps_ <= std::max(1, max_sweeps); ++sweeps_)
  {
    cholesky.solveInPlace(residual_);
    multipliers_ += residual_;
    residual_.noalias() = gaps_ - system_.selfadjointView<Eigen::Lower>() * multipliers_;
    const double error = residual_.cwiseAbs().maxCoeff();
    if (!(error > tolerance_mm) || !(error < 0.5 * last_error))
      break;
    last_error = error;
  }
  return multipliers_.allFinite();
}
} // namespace pelvireg::registration
