// A square sparse matrix in compressed columns, and its direct factorisation.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pelvireg::reference_fe
{
/// Compressed columns, 0-based, row indices ascending within a column, no duplicates.
struct SparseMatrix
{
  int n = 0;
  std::vector<int> column_start; ///< n + 1
  std::vector<int> row;          ///< number of entries
  std::vector<double> value;     ///< number of entries

  int n_entries() const { return static_cast<int>(row.size()); }
  /// y = A x
  Eigen::VectorXd multiply(const Eigen::VectorXd &x) const;
};
} // namespace pelvireg::reference_fe
