// W = H A^-1 H^T of one body by sparse right-hand sides.
#pragma once

#include "registration/solver/supernodal_factor.h"

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// Rows of H over one body's unknowns, compressed: row k holds entries starts[k] … starts[k + 1] - 1.
struct SparseRows
{
  std::vector<int> starts{0};
  std::vector<int> columns;
  std::vector<double> values;

  int size() const { return static_cast<int>(starts.size()) - 1; }
  void clear()
  {
    starts.assign(1, 0);
    columns.clear();
    values.clear();
  }
};

/// Computes W = (L^-1 H^T)^T (L^-1 H^T) and visits, for each row, only the supernodes on the paths of the elimination
/// tree from the row's non-zeros to the root: everywhere else L^-1 H^T is zero (Gilbert & Peierls, SIAM J. Sci. Stat.
/// Comput. 9, 1988). All work in a supernode is dense (BLAS 3) over the rows that reach it.
class Compliance
{
public:
  void compute(const SupernodalFactor &factor, const SparseRows &rows);

  /// Lower triangle is set; rows.size() square; mm/N.
  const Eigen::MatrixXd &result() const { return result_; }

private:
  void mark_reach(const SupernodalFactor &factor, const SparseRows &rows);
  void eliminate(const Supernode &node, const std::vector<int> &active);

  Eigen::MatrixXd result_;
  Eigen::MatrixXd right_sides_;              ///< one column an unknown, one row a constraint row: H, then (L^-1 H^T)^T
  std::vector<std::vector<int>> reached_by_; ///< rows that reach each supernode, ascending
  std::vector<int> last_row_seen_;
  std::vector<double> top_, below_,
      product_; ///< scratch of one supernode; they only grow, so that steps do not allocate
};
} // namespace pelvireg::registration
