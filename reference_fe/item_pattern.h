// Which unknowns the items of a term touch, and where their tangents go in the sparse matrix.
#pragma once

#include "reference_fe/sparse_matrix.h"
#include "reference_fe/term.h"

#include <cstddef>
#include <vector>

namespace pelvireg::reference_fe
{
/// The items of one term, one after the other.
class ItemPattern
{
public:
  /// Ask the term anew.
  void collect(const Term &term);
  /// Find every entry in the columns of `matrix`; free_index gives the row and column of each unknown, -1 when fixed.
  /// False: the matrix lacks an entry.
  bool locate(const SparseMatrix &matrix, const std::vector<int> &free_index);

  int n_items() const { return static_cast<int>(unknown_start_.size()) - 1; }
  int n_unknowns(int item) const { return static_cast<int>(unknown_start_[item + 1] - unknown_start_[item]); }
  const int *unknowns(int item) const { return unknown_.data() + unknown_start_[item]; }
  /// Index into SparseMatrix::value of each entry of the item's tangent, column by column; -1: fixed row or column.
  const int *locations(int item) const { return location_.data() + location_start_[item]; }

private:
  std::vector<std::size_t> unknown_start_ = {0}, location_start_ = {0}; ///< of every item, + total
  std::vector<int> unknown_, location_;
};

/// Sparsity pattern of the sum of all items over the free unknowns, with a diagonal entry everywhere (saddle-point rows
/// have none of their own) and with every entry of `base` when it has the same size. Values are zero.
SparseMatrix joined_pattern(const std::vector<ItemPattern> &terms, const std::vector<int> &free_index, int n_free,
                            const SparseMatrix &base);
} // namespace pelvireg::reference_fe
