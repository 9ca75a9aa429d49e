#include "reference_fe/sparse_lu.h"

#include "synthetic/dataset/error.h"

#include <umfpack.h>

#include <string>

namespace pelvireg::reference_fe
{
Eigen::VectorXd SparseMatrix::multiply(const Eigen::VectorXd &x) const
{
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  for (int column = 0; column < n; ++column)
    for (int k = column_start[column]; k < column_start[column + 1]; ++k)
      y[row[k]] += value[k] * x[column];
  return y;
}

struct SparseLu::Factors
{
  void *symbolic = nullptr;
  void *numeric = nullptr;
  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];

  Factors()
  {
    umfpack_di_defaults(control);
    // The pattern is symmetric: an ordering of A + A' with diagonal pivots fills less than one of A'A.
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    // Newton's next iteration corrects what a refinement of the solution would, at no cost.
    control[UMFPACK_IRSTEP] = 0;
  }
  ~Factors()
  {
    free_numeric();
    free_symbolic();
  }
  void free_numeric()
  {
    if (numeric)
      umfpack_di_free_numeric(&numeric);
    numeric = nullptr;
  }
  void free_symbolic()
  {
    if (symbolic)
      umfpack_di_free_symbolic(&symbolic);
    symbolic = nullptr;
  }
};

SparseLu::SparseLu() : factors_(std::make_unique<Factors>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu &&) noexcept = default;
SparseLu &SparseLu::operator=(SparseLu &&) noexcept = default;

void SparseLu::analyse(const SparseMatrix &matrix)
{
  factors_->free_numeric();
  factors_->free_symbolic();
  const int status = umfpack_di_symbolic(matrix.n, matrix.n, matrix.column_start.data(), matrix.row.data(),
                                         matrix.value.data(), &factors_->symbolic, factors_->control, factors_->info);
  if (status != UMFPACK_OK)
    throw ComputationError("the symbolic factorisation of the tangent (" + std::to_string(matrix.n) +
                           " unknowns) failed with UMFPACK status " + std::to_string(status) +
                           "; is a row without any entry, or the memory too small?");
}

bool SparseLu::factorise(const SparseMatrix &matrix)
{
  factors_->free_numeric();
  const int status = umfpack_di_numeric(matrix.column_start.data(), matrix.row.data(), matrix.value.data(),
                                        factors_->symbolic, &factors_->numeric, factors_->control, factors_->info);
  return status == UMFPACK_OK;
}

Eigen::VectorXd SparseLu::solve(const Eigen::VectorXd &rhs) const
{
  Eigen::VectorXd x(rhs.size());
  // The matrix itself would only be asked for by a refinement.
  const int status = umfpack_di_solve(UMFPACK_A, nullptr, nullptr, nullptr, x.data(), rhs.data(), factors_->numeric,
                                      factors_->control, factors_->info);
  if (status != UMFPACK_OK && status != UMFPACK_WARNING_singular_matrix)
    throw ComputationError("the solve with the factorised tangent failed with UMFPACK status " +
                           std::to_string(status));
  return x;
}

double SparseLu::n_factor_entries() const
{
  return factors_->info[UMFPACK_LNZ] + factors_->info[UMFPACK_UNZ];
}
} // namespace pelvireg::reference_fe
