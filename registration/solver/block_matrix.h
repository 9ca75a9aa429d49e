// Symmetric sparse matrix of 3 x 3 node blocks, lower part.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pelvireg::registration
{
/// The pattern is fixed at construction; only values change. Block columns hold the blocks at or below the diagonal by
/// ascending row; the diagonal block is stored whole and its upper entries are never read by the factorisation.
class SymmetricBlockMatrix
{
public:
  static constexpr int block_size = 9; ///< values of a block, column-major

  SymmetricBlockMatrix() = default;

  /// Pattern of n block rows coupled by cliques (each a list of block indices, 0-based, of one element).
  SymmetricBlockMatrix(int n_blocks, const std::vector<std::vector<int>> &cliques);

  int n_blocks() const { return n_blocks_; }
  int n_rows() const { return 3 * n_blocks_; }
  /// Block column c holds blocks block_starts()[c] … block_starts()[c + 1] - 1, of rows block_rows()[…].
  const std::vector<int> &block_starts() const { return block_starts_; }
  const std::vector<int> &block_rows() const { return block_rows_; }
  /// Block k lies at values() + 9 k.
  const double *values() const { return values_.data(); }
  double *values() { return values_.data(); }

  /// Index of block (row, column), row >= column, which must be in the pattern.
  int find(int row, int column) const;

  void set_zero();
  void add(int block, const Eigen::Matrix3d &values)
  {
    Eigen::Map<Eigen::Matrix3d>(values_.data() + block_size * block) += values;
  }
  void add_to_diagonal(int row, double value);

private:
  int n_blocks_ = 0;
  std::vector<int> block_starts_{0};
  std::vector<int> block_rows_;
  std::vector<double> values_;
};
} // namespace pelvireg::registration
