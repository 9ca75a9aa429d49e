#include "registration/solver/constraint_solver.h"

#include <cblas.h>

#include <algorithm>

// Cholesky factor of LAPACK, from OpenBLAS: some times faster than Eigen's on plain x86-64, and without allocations.
extern "C" void dpotrf_(const char *triangle, const int *n, double *matrix, const int *stride, int *info);

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
  const int n = static_cast<int>(gaps_.size());
  int failed = 0;
  dpotrf_("L", &n, factor_.data(), &n, &failed);
  if (failed != 0)
    return false;
  residual_ = gaps_;
  double last_error = residual_.cwiseAbs().maxCoeff();
  for (sweeps_ = 1; sweeps_ <= std::max(1, max_sweeps); ++sweeps_)
  {
    for (const CBLAS_TRANSPOSE transposed : {CblasNoTrans, CblasTrans})
      cblas_dtrsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, n, factor_.data(), n, residual_.data(), 1);
    multipliers_ += residual_;
    residual_ = gaps_;
    cblas_dsymv(CblasColMajor, CblasLower, n, -1.0, system_.data(), n, multipliers_.data(), 1, 1.0, residual_.data(),
                1);
    const double error = residual_.cwiseAbs().maxCoeff();
    if (!(error > tolerance_mm) || !(error < 0.5 * last_error))
      break;
    last_error = error;
  }
  return multipliers_.allFinite();
}
} // namespace pelvireg::registration
