// Symmetric sparse matrix of 3 x 3 node blocks, lower part, in the column layout that CHOLMOD reads.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// Where a 3 x 3 block lies in SymmetricBlockMatrix::values(): entry (r, c) is values[offset + c * stride + r].
struct BlockSlot
{
  int offset = 0;
  int stride = 0;
};

/// The pattern is fixed at construction; only values change. Block columns hold the rows at or below the diagonal; the
/// diagonal block is stored whole and its upper entries are never read by the factorisation.
class SymmetricBlockMatrix
{
public:
  SymmetricBlockMatrix() = default;

  /// Pattern of n block rows coupled by cliques (each a list of block indices, 0-based, of one element).
  SymmetricBlockMatrix(int n_blocks, const std::vector<std::vector<int>> &cliques);

  int n_rows() const { return 3 * n_blocks_; }
  const std::vector<int> &column_starts() const { return column_starts_; }
  const std::vector<int> &row_indices() const { return row_indices_; }
  const std::vector<double> &values() const { return values_; }

  /// Slot of block (row, column), row >= column, which must be in the pattern.
  BlockSlot slot(int row, int column) const;

  void set_zero();
  void add(const BlockSlot &slot, const Eigen::Matrix3d &block)
  {
    for (int c = 0; c < 3; ++c)
      Eigen::Map<Eigen::Vector3d>(values_.data() + slot.offset + c * slot.stride) += block.col(c);
  }
  void add_to_diagonal(int block, double value);

private:
  int n_blocks_ = 0;
  std::vector<int> block_starts_; ///< n_blocks + 1
  std::vector<int> block_rows_;   ///< sorted in each column
  std::vector<int> column_starts_;
  std::vector<int> row_indices_;
  std::vector<double> values_;
};
} // namespace pelvireg::registration
