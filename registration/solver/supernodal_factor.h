// Supernodal Cholesky factor of one body's matrix (CHOLMOD), with access to its supernodes.
#pragma once

#include "registration/solver/block_matrix.h"

#include <memory>
#include <vector>

namespace pelvireg::registration
{
/// Order of the blocks that keeps the factor sparse: result[k] is the block eliminated k-th (CHOLMOD's best of AMD and
/// METIS, postordered). `cliques` as in SymmetricBlockMatrix.
std::vector<int> fill_reducing_order(int n_blocks, const std::vector<std::vector<int>> &cliques);

/// One supernode: consecutive columns of L with the same rows. `values` is column-major, `n_rows` x `n_columns`; its
/// first n_columns rows are the dense lower triangle of the diagonal block.
struct Supernode
{
  int first_column = 0;
  int n_columns = 0;
  int n_rows = 0;
  const int *rows = nullptr; ///< indices of all n_rows rows, ascending
  const double *values = nullptr;
};

/// A = L L^T. The symbolic phase runs once, at construction; the matrix must already be in a fill-reducing order.
class SupernodalFactor
{
public:
  explicit SupernodalFactor(const SymmetricBlockMatrix &matrix);
  ~SupernodalFactor();
  SupernodalFactor(SupernodalFactor &&) noexcept;
  SupernodalFactor &operator=(SupernodalFactor &&) noexcept;

  /// Numeric phase. False when the matrix is not positive definite to round-off or not finite; solve nothing then.
  /// The matrix must have the pattern of the constructor's.
  bool factorise(const SymmetricBlockMatrix &matrix);

  int n_rows() const { return n_rows_; }
  int n_supernodes() const { return n_supernodes_; }
  Supernode supernode(int s) const;
  int supernode_of(int column) const { return supernode_of_[column]; }
  /// The supernode that s updates next on its way to the root; -1 at a root.
  int parent(int s) const { return parent_[s]; }
  /// Non-zeros stored in L.
  long n_stored_values() const;

  /// x <- A^-1 x, x of length n_rows().
  void solve(Eigen::Ref<Eigen::VectorXd> x);

private:
  struct Cholmod;
  void solve_lower(double *x);
  void solve_upper(double *x);

  std::unique_ptr<Cholmod> cholmod_;
  int n_rows_ = 0;
  int n_supernodes_ = 0;
  std::vector<int> supernode_of_;
  std::vector<int> parent_;
  std::vector<double> gathered_; ///< rows below a diagonal block, for the solves
};
} // namespace pelvireg::registration
