// Table 1 of the paper: how large its registration models are.
#pragma once

#include <array>

namespace pelvireg::runner
{
/// In the order of Table 1, by the names of ours.
inline constexpr std::array<const char *, 7> table_one_bodies = {"vagina",        "uterus",        "bladder",  "rectum",
                                                                 "fascia_pelvis", "fascia_sacrum", "ligaments"};

/// One column of Table 1. Its "DoF" are nodes: most of them are not divisible by three.
struct TableOneColumn
{
  const char *data_set;
  std::array<int, table_one_bodies.size()> nodes; ///< of table_one_bodies
  double rate;                                    ///< steps per second that the paper reports for it

  constexpr int n_nodes() const
  {
    int sum = 0;
    for (const int n : nodes)
      sum += n;
    return sum;
  }
};

inline constexpr std::array<TableOneColumn, 2> table_one = {
    {{"T005", {928, 740, 806, 894, 170, 288, 199}, 14}, {"T007", {1789, 523, 772, 2205, 352, 326, 233}, 8}}};

/// A count within this share of Table 1's is of its size.
inline constexpr double table_one_tolerance = 0.05;

constexpr bool is_of_size(int n_nodes, int table_one_nodes)
{
  const int difference = n_nodes < table_one_nodes ? table_one_nodes - n_nodes : n_nodes - table_one_nodes;
  return difference <= table_one_tolerance * table_one_nodes;
}

/// The column of a model with so many nodes in all; null when it has the size of none.
constexpr const TableOneColumn *table_one_column(int n_nodes)
{
  for (const TableOneColumn &column : table_one)
    if (is_of_size(n_nodes, column.n_nodes()))
      return &column;
  return nullptr;
}
} // namespace pelvireg::runner
