#include "registration/solver/compliance.h"

#include <cblas.h>

#include <cstddef>

namespace pelvireg::registration
{
namespace
{
void require_size(std::vector<double> &scratch, int size)
{
  if (scratch.size() < static_cast<std::size_t>(size))
    scratch.resize(size);
}
} // namespace

void Compliance::compute(const SupernodalFactor &factor, const SparseRows &rows)
{
  const int n_rows = rows.size();
  result_.setZero(n_rows, n_rows);
  right_sides_.setZero(n_rows, factor.n_rows());
  for (int row = 0; row < n_rows; ++row)
    for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
      right_sides_(row, rows.columns[k]) += rows.values[k];
  mark_reach(factor, rows);
  for (int s = 0; s < factor.n_supernodes(); ++s)
    if (!reached_by_[s].empty())
      eliminate(factor.supernode(s), reached_by_[s]);
}

void Compliance::mark_reach(const SupernodalFactor &factor, const SparseRows &rows)
{
  reached_by_.resize(factor.n_supernodes());
  for (std::vector<int> &reached : reached_by_)
    reached.clear();
  last_row_seen_.assign(factor.n_supernodes(), -1);
  for (int row = 0; row < rows.size(); ++row)
    for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
      for (int s = factor.supernode_of(rows.columns[k]); s >= 0 && last_row_seen_[s] != row; s = factor.parent(s))
      {
        last_row_seen_[s] = row;
        reached_by_[s].push_back(row);
      }
}

void Compliance::eliminate(const Supernode &node, const std::vector<int> &active)
{
  const int n_active = static_cast<int>(active.size());
  const int n_below = node.n_rows - node.n_columns;
  const auto column_of = [n_active](std::vector<double> &matrix, int c) { return matrix.data() + c * n_active; };
  require_size(top_, n_active * node.n_columns);
  for (int c = 0; c < node.n_columns; ++c)
    for (int k = 0; k < n_active; ++k)
      column_of(top_, c)[k] = right_sides_(active[k], node.first_column + c);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, n_active, node.n_columns, 1.0,
              node.values, node.n_rows, top_.data(), n_active);

  require_size(product_, n_active * n_active);
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n_active, node.n_columns, 1.0, top_.data(), n_active, 0.0,
              product_.data(), n_active);
  for (int l = 0; l < n_active; ++l)
    for (int k = l; k < n_active; ++k)
      result_(active[k], active[l]) += column_of(product_, l)[k];

  if (n_below == 0)
    return;
  require_size(below_, n_active * n_below);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n_active, n_below, node.n_columns, 1.0, top_.data(), n_active,
              node.values + node.n_columns, node.n_rows, 0.0, below_.data(), n_active);
  for (int r = 0; r < n_below; ++r)
  {
    auto column = right_sides_.col(node.rows[node.n_columns + r]);
    for (int k = 0; k < n_active; ++k)
      column[active[k]] -= column_of(below_, r)[k];
  }
}
} // namespace pelvireg::registration
