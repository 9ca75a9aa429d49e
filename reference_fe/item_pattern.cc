#include "reference_fe/item_pattern.h"

#include <algorithm>

namespace pelvireg::reference_fe
{
void ItemPattern::collect(const Term &term)
{
  unknown_start_.assign(1, 0);
  unknown_.clear();
  std::vector<int> indices;
  for (int item = 0; item < term.n_items(); ++item)
  {
    indices.clear();
    term.unknowns(item, indices);
    unknown_.insert(unknown_.end(), indices.begin(), indices.end());
    unknown_start_.push_back(unknown_.size());
  }
}

bool ItemPattern::locate(const SparseMatrix &matrix, const std::vector<int> &free_index)
{
  location_start_.assign(1, 0);
  location_.clear();
  for (int item = 0; item < n_items(); ++item)
  {
    const int *unknown = unknowns(item);
    const int n = n_unknowns(item);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const int row = free_index[unknown[i]], column = free_index[unknown[j]];
        if (row < 0 || column < 0)
        {
          location_.push_back(-1);
          continue;
        }
        const auto begin = matrix.row.begin() + matrix.column_start[column];
        const auto end = matrix.row.begin() + matrix.column_start[column + 1];
        const auto found = std::lower_bound(begin, end, row);
        if (found == end || *found != row)
          return false;
        location_.push_back(static_cast<int>(found - matrix.row.begin()));
      }
    location_start_.push_back(location_.size());
  }
  return true;
}

SparseMatrix joined_pattern(const std::vector<ItemPattern> &terms, const std::vector<int> &free_index, int n_free,
                            const SparseMatrix &base)
{
  // Items of every free unknown, so that each column is the union of few short lists.
  struct Item
  {
    int term, item;
  };
  std::vector<std::vector<Item>> items_of(n_free);
  for (int term = 0; term < static_cast<int>(terms.size()); ++term)
    for (int item = 0; item < terms[term].n_items(); ++item)
      for (int k = 0; k < terms[term].n_unknowns(item); ++k)
        if (const int column = free_index[terms[term].unknowns(item)[k]]; column >= 0)
          items_of[column].push_back({term, item});

  SparseMatrix joined;
  joined.n = n_free;
  joined.column_start.assign(1, 0);
  std::vector<int> last_column(n_free, -1);
  for (int column = 0; column < n_free; ++column)
  {
    const auto add = [&](int row)
    {
      if (row >= 0 && last_column[row] != column)
      {
        last_column[row] = column;
        joined.row.push_back(row);
      }
    };
    add(column);
    for (const auto &[term, item] : items_of[column])
      for (int k = 0; k < terms[term].n_unknowns(item); ++k)
        add(free_index[terms[term].unknowns(item)[k]]);
    if (base.n == n_free)
      for (int k = base.column_start[column]; k < base.column_start[column + 1]; ++k)
        add(base.row[k]);
    std::sort(joined.row.begin() + joined.column_start.back(), joined.row.end());
    joined.column_start.push_back(static_cast<int>(joined.row.size()));
  }
  joined.value.assign(joined.row.size(), 0.0);
  return joined;
}
} // namespace pelvireg::reference_fe
