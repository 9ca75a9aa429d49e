#include "registration/solver/constraint_solver.h"

#include <cblas.h>

#include <algorithm>
#include <cmath>

// Cholesky factor of LAPACK, from OpenBLAS: some times faster than Eigen's on plain x86-64, and without allocations.
extern "C" void dpotrf_(const char *triangle, const int *n, double *matrix, const int *stride, int *info);

namespace pelvireg::registration
{
namespace
{
void require_size(std::vector<double> &buffer, std::size_t size)
{
  if (buffer.size() < size)
    buffer.resize(size);
}

double largest_magnitude(const double *values, int n)
{
  double largest = 0;
  for (int i = 0; i < n; ++i)
    if (!(std::abs(values[i]) <= largest))
      largest = std::abs(values[i]);
  return largest;
}
} // namespace

ConstraintSolver::ConstraintSolver()
{
  openblas_set_num_threads(1);
}

void ConstraintSolver::reserve(int n_bilateral, int n_contact_rows)
{
  const std::size_t b = n_bilateral, c = n_contact_rows, n = b + c;
  system_.reserve(n * n);
  factor_.reserve(b * b);
  coupling_.reserve(c * b);
  condensed_.reserve(c * c);
  condensed_gaps_.reserve(c);
  for (std::vector<double> *list : {&right_side_, &gaps_, &compliances_})
    list->reserve(n);
  if (multipliers_.size() < static_cast<Eigen::Index>(n))
    multipliers_.setZero(static_cast<Eigen::Index>(n));
  contact_sweeps_.reserve(n_contact_rows);
}

void ConstraintSolver::reset(int n_rows, int n_bilateral, int rows_per_contact, double friction_coefficient)
{
  n_rows_ = n_rows;
  n_bilateral_ = n_bilateral;
  const auto n = static_cast<std::size_t>(n_rows);
  require_size(system_, n * n);
  std::fill_n(system_.begin(), n * n, 0.0);
  require_size(gaps_, n);
  require_size(compliances_, n);
  std::fill_n(gaps_.begin(), n, 0.0);
  std::fill_n(compliances_.begin(), n, 0.0);
  if (multipliers_.size() < n_rows)
    multipliers_.resize(n_rows);
  multipliers_.setZero();
  contact_problem_ = {n_rows - n_bilateral, rows_per_contact, friction_coefficient, nullptr, nullptr};
  contact_residual_ = {};
  sweeps_ = 0;
}

void ConstraintSolver::add_compliance(const std::vector<int> &rows, const Eigen::Ref<const Eigen::MatrixXd> &lower)
{
  for (std::size_t l = 0; l < rows.size(); ++l)
    for (std::size_t k = l; k < rows.size(); ++k)
      at(rows[k], rows[l]) += lower(k, l);
}

void ConstraintSolver::set_row(int row, double gap, double compliance)
{
  gaps_[row] = gap;
  compliances_[row] = compliance;
}

bool ConstraintSolver::solve(const SweepLimits &limits)
{
  if (n_rows_ == 0)
    return true;
  double mean = 0;
  for (int row = 0; row < n_rows_; ++row)
    mean += at(row, row) / n_rows_;
  const double least = least_relative_compliance * mean;
  for (int row = 0; row < n_rows_; ++row)
    at(row, row) += std::max(least, compliances_[row]);
  if (!factorise_bilateral())
    return false;
  if (contact_problem_.n_rows > 0)
    solve_contacts(limits);
  return solve_bilateral(limits) && multipliers_.allFinite();
}

bool ConstraintSolver::factorise_bilateral()
{
  const int n = n_bilateral_;
  require_size(factor_, static_cast<std::size_t>(n) * n);
  for (int column = 0; column < n; ++column)
    std::copy_n(&at(0, column), n, factor_.data() + static_cast<std::size_t>(column) * n);
  int failed = 0;
  if (n > 0)
    dpotrf_("L", &n, factor_.data(), &n, &failed);
  return failed == 0;
}

void ConstraintSolver::solve_contacts(const SweepLimits &limits)
{
  const int n = contact_problem_.n_rows, m = n_bilateral_;
  require_size(condensed_, static_cast<std::size_t>(n) * n);
  require_size(condensed_gaps_, n);
  require_size(coupling_, static_cast<std::size_t>(n) * m);
  require_size(right_side_, m);
  for (int column = 0; column < n; ++column)
    std::copy_n(&at(m, m + column), n, condensed_.data() + static_cast<std::size_t>(column) * n);
  std::copy_n(gaps_.data() + m, n, condensed_gaps_.data());
  if (m > 0)
  {
    for (int column = 0; column < m; ++column)
      std::copy_n(&at(m, column), n, coupling_.data() + static_cast<std::size_t>(column) * n);
    std::copy_n(gaps_.data(), m, right_side_.data());
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, n, m, 1.0, factor_.data(), m,
                coupling_.data(), n);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, m, -1.0, coupling_.data(), n, 1.0, condensed_.data(), n);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, m, factor_.data(), m, right_side_.data(), 1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, n, m, -1.0, coupling_.data(), n, right_side_.data(), 1, 1.0,
                condensed_gaps_.data(), 1);
  }
  for (int column = 0; column < n; ++column)
    for (int row = 0; row < column; ++row)
      condensed_[static_cast<std::size_t>(column) * n + row] = condensed_[static_cast<std::size_t>(row) * n + column];
  contact_problem_.matrix = condensed_.data();
  contact_problem_.gaps = condensed_gaps_.data();
  sweeps_ = contact_sweeps_.solve(contact_problem_, limits, multipliers_.data() + m);
  contact_residual_ = contact_sweeps_.residual(contact_problem_, multipliers_.data() + m);
}

bool ConstraintSolver::solve_bilateral(const SweepLimits &limits)
{
  const int n = n_bilateral_, n_contact = contact_problem_.n_rows;
  if (n == 0)
    return true;
  require_size(right_side_, n);
  if (n_contact > 0) // what the contacts' forces leave to close
    cblas_dgemv(CblasColMajor, CblasTrans, n_contact, n, -1.0, &at(n, 0), n_rows_, multipliers_.data() + n, 1, 1.0,
                gaps_.data(), 1);
  std::copy_n(gaps_.data(), n, right_side_.data());
  double last_error = largest_magnitude(right_side_.data(), n);
  int refinements = 1;
  for (; refinements <= std::max(1, limits.max_sweeps); ++refinements)
  {
    for (const CBLAS_TRANSPOSE transposed : {CblasNoTrans, CblasTrans})
      cblas_dtrsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, n, factor_.data(), n, right_side_.data(), 1);
    for (int row = 0; row < n; ++row)
      multipliers_[row] += right_side_[row];
    std::copy_n(gaps_.data(), n, right_side_.data());
    cblas_dsymv(CblasColMajor, CblasLower, n, -1.0, system_.data(), n_rows_, multipliers_.data(), 1, 1.0,
                right_side_.data(), 1);
    const double error = largest_magnitude(right_side_.data(), n);
    if (!(error > limits.tolerance_mm) || !(error < 0.5 * last_error))
      break;
    last_error = error;
  }
  if (n_contact == 0)
    sweeps_ = refinements;
  return true;
}
} // namespace pelvireg::registration
