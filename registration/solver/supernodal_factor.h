// Multifrontal Cholesky factor of one body's matrix.
#pragma once

#include "registration/kernels/aligned_array.h"
#include "registration/kernels/kernels.h"
#include "registration/solver/block_matrix.h"
#include "registration/solver/supernode_tree.h"

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// A = L L^T by the multifrontal method (Duff & Reid, ACM TOMS 9, 1983): a supernode's columns are gathered from A and
/// from its children's update matrices, factorised densely, and leave an update matrix for its parent. The symbolic
/// phase, all memory and all index lists are made once, at construction; the numeric phase allocates nothing.
class SupernodalFactor
{
public:
  /// The matrix must already be in a fill-reducing, postordered order.
  explicit SupernodalFactor(const SymmetricBlockMatrix &matrix, const kernels::Kernels &kernels = kernels::best());

  /// Numeric phase. False when the matrix is not positive definite to round-off or not finite; solve nothing then.
  /// The matrix must have the pattern of the constructor's.
  bool factorise(const SymmetricBlockMatrix &matrix);

  int n_rows() const { return n_rows_; }
  int n_supernodes() const { return static_cast<int>(fronts_.size()); }
  int first_column(int s) const { return fronts_[s].first_column; }
  kernels::SupernodeColumns columns(int s) const;
  int supernode_of(int column) const { return supernode_of_[column]; }
  /// The supernode that s updates next on its way to the root; -1 at a root.
  int parent(int s) const { return fronts_[s].parent; }
  const kernels::Kernels &kernels() const { return *kernels_; }
  /// Values stored for L, the zeros that fill its dense blocks included.
  long n_stored_values() const { return static_cast<long>(values_.size()); }

  /// x <- L^-1 x and x <- L^-T x, x of length n_rows().
  void solve_lower(double *x) const;
  void solve_upper(double *x) const;
  /// x <- A^-1 x.
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;

private:
  struct Front
  {
    int first_column = 0, n_columns = 0;
    int first_row = 0, n_below = 0; ///< range of rows_
    int parent = -1;
    int first_child = 0, last_child = 0; ///< range of children_
    /// Range of runs_ that carries the update matrix to the parent; those before `split` go to its columns.
    int first_run = 0, split = 0, last_run = 0;
    long values = 0; ///< place in values_
    int stack = 0;
    long update = 0; ///< place of the update matrix in stacks_[stack]
  };

  void make_fronts(const SupernodeTree &tree);
  void make_runs(const SupernodeTree &tree);
  void place_updates();
  void place_blocks(const SymmetricBlockMatrix &matrix);
  void gather(const SymmetricBlockMatrix &matrix, const Front &front);
  double *update_of(const Front &front) const { return stacks_[front.stack].data() + front.update; }

  const kernels::Kernels *kernels_;
  int n_rows_ = 0;
  std::vector<Front> fronts_;
  std::vector<int> supernode_of_; ///< of a column
  std::vector<int> rows_;         ///< below the diagonal blocks, of all fronts
  std::vector<int> children_;
  std::vector<kernels::Run> runs_;
  std::vector<int> block_places_; ///< in its front's columns, of every block of A
  kernels::AlignedArray values_, inverse_diagonal_;
  kernels::AlignedArray scratch_; ///< of one solve: a factor serves one thread at a time
  /// Update matrices that wait for their parents, last in first out: those of even and of odd depth apart, so that a
  /// front's own matrix does not bury its children's.
  kernels::AlignedArray stacks_[2];
};
} // namespace pelvireg::registration
