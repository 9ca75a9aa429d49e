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
  void reserve(std::size_t n_rows, std::size_t n_entries)
  {
    starts.reserve(n_rows + 1);
    columns.reserve(n_entries);
    values.reserve(n_entries);
  }
  void clear()
  {
    starts.assign(1, 0);
    columns.clear();
    values.clear();
  }
};

/// Computes W = Z^T Z, Z = L^-1 H^T, and visits for each row only the supernodes on the paths of the elimination tree
/// from the row's non-zeros to the root: everywhere else Z is zero (Gilbert & Peierls, SIAM J. Sci. Stat. Comput. 9,
/// 1988). Rows that start close to each other in the tree share most of their paths: they are taken in groups of
/// kernels::width, so that all work is on full registers.
class Compliance
{
public:
  /// Set memory aside for so many rows.
  void reserve(const SupernodalFactor &factor, int n_rows);

  /// `load` is L^-1 b: H A^-1 b = Z^T (L^-1 b) comes along.
  void compute(const SupernodalFactor &factor, const SparseRows &rows, const Eigen::VectorXd &load);

  /// Lower triangle is set; rows.size() square; mm/N.
  Eigen::Map<const Eigen::MatrixXd> result() const
  {
    const auto n_rows = static_cast<Eigen::Index>(order_.size());
    return {result_.data(), n_rows, n_rows};
  }

  /// H A^-1 b of row k, mm.
  double free_change(int k) const { return free_changes_.data()[place_[k]]; }

  /// x <- x + Z factors: L^-1 H^T factors without another pass over L. `factor` as in compute(); one factor a row, N.
  template <class Factors>
  void add_combination(const SupernodalFactor &factor, const Factors &factors, Eigen::VectorXd &x)
  {
    for (std::size_t k = 0; k < place_.size(); ++k)
      factors_.data()[place_[k]] = factors(static_cast<int>(k));
    add_combination(factor, x);
  }

private:
  void group_rows(const SupernodalFactor &factor, const SparseRows &rows);
  void mark_reach(const SupernodalFactor &factor, const SparseRows &rows);
  void set_right_sides(const SupernodalFactor &factor, const SparseRows &rows);
  void set_result();
  kernels::RightSides sides_at(int supernode) const;
  void add_combination(const SupernodalFactor &factor, Eigen::VectorXd &x) const;

  std::vector<double> result_; ///< column-major; only grows
  int n_groups_ = 0;
  std::vector<int> first_supernode_;         ///< of each row
  std::vector<int> order_, place_;           ///< order_[place] = row; place = group * width + lane
  std::vector<std::vector<int>> reached_by_; ///< groups that reach each supernode, ascending
  std::vector<int> last_group_seen_;
  std::vector<double *> group_values_;
  kernels::AlignedArray right_sides_, products_, free_changes_, factors_;
};
} // namespace pelvireg::registration
