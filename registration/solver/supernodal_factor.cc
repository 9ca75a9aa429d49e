#include "registration/solver/supernodal_factor.h"

#include <algorithm>

namespace pelvireg::registration
{
using kernels::padded;
using kernels::Run;
using kernels::SupernodeColumns;

SupernodalFactor::SupernodalFactor(const SymmetricBlockMatrix &matrix, const kernels::Kernels &kernels)
    : kernels_(&kernels), n_rows_(matrix.n_rows())
{
  const SupernodeTree tree = analyse(matrix);
  make_fronts(tree);
  make_runs(tree);
  place_updates();
  place_blocks(matrix);
}

void SupernodalFactor::make_fronts(const SupernodeTree &tree)
{
  fronts_.resize(tree.size());
  supernode_of_.resize(n_rows_);
  long n_values = 0;
  for (int s = 0; s < tree.size(); ++s)
  {
    Front &front = fronts_[s];
    front.first_column = 3 * tree.first_block[s];
    front.n_columns = 3 * tree.first_block[s + 1] - front.first_column;
    front.first_row = static_cast<int>(rows_.size());
    for (int k = tree.below_starts[s]; k < tree.below_starts[s + 1]; ++k)
      for (int axis = 0; axis < 3; ++axis)
        rows_.push_back(3 * tree.below_rows[k] + axis);
    front.n_below = static_cast<int>(rows_.size()) - front.first_row;
    front.parent = tree.parent[s];
    front.values = n_values;
    n_values += static_cast<long>(front.n_columns) * (padded(front.n_columns) + padded(front.n_below));
    std::fill_n(supernode_of_.begin() + front.first_column, front.n_columns, s);
  }
  std::vector<std::vector<int>> children(tree.size());
  for (int s = 0; s < tree.size(); ++s)
    if (tree.parent[s] >= 0)
      children[tree.parent[s]].push_back(s);
  for (int s = 0; s < tree.size(); ++s)
  {
    fronts_[s].first_child = static_cast<int>(children_.size());
    children_.insert(children_.end(), children[s].begin(), children[s].end());
    fronts_[s].last_child = static_cast<int>(children_.size());
  }
  int most_below = 0;
  for (const Front &front : fronts_)
    most_below = std::max(most_below, front.n_below);
  scratch_.require(padded(most_below));
  values_.require(n_values);
  inverse_diagonal_.require(n_rows_);
}

void SupernodalFactor::make_runs(const SupernodeTree &tree)
{
  for (int s = 0; s < tree.size(); ++s)
  {
    Front &front = fronts_[s];
    front.first_run = front.split = front.last_run = static_cast<int>(runs_.size());
    if (front.parent < 0)
      continue;
    const Front &parent = fronts_[front.parent];
    const auto first = tree.below_rows.begin() + tree.below_starts[front.parent];
    const auto last = tree.below_rows.begin() + tree.below_starts[front.parent + 1];
    bool is_below = false;
    for (int k = tree.below_starts[s]; k < tree.below_starts[s + 1]; ++k)
    {
      const int row = tree.below_rows[k], source = 3 * (k - tree.below_starts[s]);
      const bool was_below = is_below;
      is_below = 3 * row >= parent.first_column + parent.n_columns;
      const int target =
          is_below ? padded(parent.n_columns) + 3 * static_cast<int>(std::lower_bound(first, last, row) - first)
                   : 3 * row - parent.first_column;
      const bool has_run = static_cast<int>(runs_.size()) > front.first_run;
      if (has_run && was_below == is_below && runs_.back().target + runs_.back().length == target)
        runs_.back().length += 3;
      else
        runs_.push_back({source, 3, target});
      front.last_run = static_cast<int>(runs_.size());
      if (!is_below)
        front.split = front.last_run;
    }
  }
}

void SupernodalFactor::place_updates()
{
  for (int s = n_supernodes() - 1; s >= 0; --s)
    fronts_[s].stack = fronts_[s].parent < 0 ? 0 : 1 - fronts_[fronts_[s].parent].stack;
  const auto size = [](const Front &front) { return static_cast<long>(front.n_below) * padded(front.n_below); };
  long top[2] = {0, 0}, most[2] = {0, 0};
  for (Front &front : fronts_)
  {
    front.update = top[front.stack];
    top[front.stack] += size(front);
    most[front.stack] = std::max(most[front.stack], top[front.stack]);
    for (int c = front.first_child; c < front.last_child; ++c)
      top[1 - front.stack] -= size(fronts_[children_[c]]);
  }
  for (const int stack : {0, 1})
    stacks_[stack].require(most[stack]);
}

void SupernodalFactor::place_blocks(const SymmetricBlockMatrix &matrix)
{
  block_places_.resize(matrix.block_rows().size());
  for (int column = 0; column < matrix.n_blocks(); ++column)
  {
    const Front &front = fronts_[supernode_of_[3 * column]];
    const SupernodeColumns columns = this->columns(supernode_of_[3 * column]);
    for (int k = matrix.block_starts()[column]; k < matrix.block_starts()[column + 1]; ++k)
    {
      const int row = 3 * matrix.block_rows()[k];
      const bool is_below = row >= front.first_column + front.n_columns;
      const int *place = is_below ? std::lower_bound(columns.rows, columns.rows + front.n_below, row) : nullptr;
      block_places_[k] =
          (3 * column - front.first_column) * columns.stride() +
          (is_below ? padded(front.n_columns) + static_cast<int>(place - columns.rows) : row - front.first_column);
    }
  }
}

SupernodeColumns SupernodalFactor::columns(int s) const
{
  const Front &front = fronts_[s];
  return {values_.data() + front.values, inverse_diagonal_.data() + front.first_column, front.n_columns, front.n_below,
          rows_.data() + front.first_row};
}

void SupernodalFactor::gather(const SymmetricBlockMatrix &matrix, const Front &front)
{
  const long stride = padded(front.n_columns) + padded(front.n_below);
  double *values = values_.data() + front.values;
  std::fill_n(values, stride * front.n_columns, 0.0);
  const int first = front.first_column / 3, last = first + front.n_columns / 3;
  for (int k = matrix.block_starts()[first]; k < matrix.block_starts()[last]; ++k)
    for (int c = 0; c < 3; ++c)
      std::copy_n(matrix.values() + SymmetricBlockMatrix::block_size * k + 3 * c, 3,
                  values + block_places_[k] + c * stride);
}

bool SupernodalFactor::factorise(const SymmetricBlockMatrix &matrix)
{
  for (int s = 0; s < n_supernodes(); ++s)
  {
    const Front &front = fronts_[s];
    const SupernodeColumns columns = this->columns(s);
    const auto add_children = [&](bool to_columns)
    {
      for (int c = front.first_child; c < front.last_child; ++c)
      {
        const Front &child = fronts_[children_[c]];
        const int split = child.split - child.first_run, n_runs = child.last_run - child.first_run;
        kernels_->extend_add(
            update_of(child), padded(child.n_below), runs_.data() + child.first_run, to_columns ? 0 : split,
            to_columns ? split : n_runs, n_runs, to_columns ? columns.values : update_of(front),
            to_columns ? columns.stride() : padded(front.n_below), to_columns ? 0 : padded(front.n_columns));
      }
    };
    gather(matrix, front);
    add_children(true);
    if (!kernels_->factorise_columns(columns))
      return false;
    if (front.n_below == 0)
      continue;
    kernels_->update_matrix(columns, update_of(front));
    add_children(false);
  }
  return true;
}

void SupernodalFactor::solve_lower(double *x) const
{
  for (int s = 0; s < n_supernodes(); ++s)
    kernels_->solve_lower(columns(s), x + first_column(s), x, scratch_.data());
}

void SupernodalFactor::solve_upper(double *x) const
{
  for (int s = n_supernodes() - 1; s >= 0; --s)
    kernels_->solve_upper(columns(s), x + first_column(s), x, scratch_.data());
}

void SupernodalFactor::solve(Eigen::Ref<Eigen::VectorXd> x) const
{
  solve_lower(x.data());
  solve_upper(x.data());
}
} // namespace pelvireg::registration
