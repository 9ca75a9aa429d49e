#include "registration/solver/block_matrix.h"

#include <algorithm>

namespace pelvireg::registration
{
SymmetricBlockMatrix::SymmetricBlockMatrix(int n_blocks, const std::vector<std::vector<int>> &cliques)
    : n_blocks_(n_blocks), block_starts_(n_blocks + 1, 0)
{
  std::vector<std::vector<int>> rows_of(n_blocks);
  for (int block = 0; block < n_blocks; ++block)
    rows_of[block].push_back(block);
  for (const std::vector<int> &clique : cliques)
    for (const int column : clique)
      for (const int row : clique)
        if (row > column)
          rows_of[column].push_back(row);
  for (int column = 0; column < n_blocks; ++column)
  {
    std::vector<int> &rows = rows_of[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    block_rows_.insert(block_rows_.end(), rows.begin(), rows.end());
    block_starts_[column + 1] = static_cast<int>(block_rows_.size());
  }
  values_.assign(block_size * block_rows_.size(), 0.0);
}

int SymmetricBlockMatrix::find(int row, int column) const
{
  const auto first = block_rows_.begin() + block_starts_[column];
  const auto last = block_rows_.begin() + block_starts_[column + 1];
  return static_cast<int>(std::lower_bound(first, last, row) - block_rows_.begin());
}

void SymmetricBlockMatrix::set_zero()
{
  std::fill(values_.begin(), values_.end(), 0.0);
}

void SymmetricBlockMatrix::add_to_diagonal(int row, double value)
{
  double *diagonal = values_.data() + block_size * block_starts_[row]; // the diagonal is the column's first block
  for (const int entry : {0, 4, 8})
    diagonal[entry] += value;
}
} // namespace pelvireg::registration
