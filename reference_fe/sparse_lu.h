// Unsymmetric sparse LU (UMFPACK): follower pressure and cavities make unsymmetric saddle-point systems.
#pragma once

#include "reference_fe/sparse_matrix.h"

#include <memory>

namespace pelvireg::reference_fe
{
class SparseLu
{
public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu &&) noexcept;
  SparseLu &operator=(SparseLu &&) noexcept;

  /// Symbolic phase: needed once for a sparsity pattern. `matrix.value` is used for pivoting hints only.
  void analyse(const SparseMatrix &matrix);
  /// Numeric phase. Returns false when the matrix is singular or not finite.
  bool factorise(const SparseMatrix &matrix);
  /// x with A x = rhs, A the matrix factorised last.
  Eigen::VectorXd solve(const Eigen::VectorXd &rhs) const;
  /// Entries of L and U: the memory is 12 bytes each.
  double n_factor_entries() const;

private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};
} // namespace pelvireg::reference_fe
