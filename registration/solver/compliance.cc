#include "registration/solver/compliance.h"

#include <algorithm>
#include <numeric>

namespace pelvireg::registration
{
using kernels::width;

void Compliance::compute(const SupernodalFactor &factor, const SparseRows &rows, const Eigen::VectorXd &load)
{
  group_rows(factor, rows);
  mark_reach(factor, rows);
  set_right_sides(factor, rows);
  const kernels::Kernels &kernels = factor.kernels();
  for (int s = 0; s < factor.n_supernodes(); ++s)
  {
    const kernels::RightSides sides = sides_at(s);
    if (sides.n_groups == 0)
      continue;
    const kernels::SupernodeColumns columns = factor.columns(s);
    const int first = factor.first_column(s);
    kernels.eliminate(columns, first, sides);
    kernels.accumulate_products(first, columns.n_columns, sides, products_.data());
    kernels.accumulate_dots(first, columns.n_columns, sides, load.data(), free_changes_.data());
  }
  set_result();
}

void Compliance::reserve(const SupernodalFactor &factor, int n_rows)
{
  const std::size_t n_padded = kernels::padded(n_rows), n_groups = n_padded / width;
  for (std::vector<int> *list : {&first_supernode_, &order_, &place_})
    list->reserve(n_rows);
  reached_by_.resize(factor.n_supernodes());
  for (std::vector<int> &reached : reached_by_)
    reached.reserve(n_groups);
  last_group_seen_.reserve(factor.n_supernodes());
  group_values_.reserve(n_groups);
  result_.reserve(static_cast<std::size_t>(n_rows) * n_rows);
  right_sides_.require(n_padded * factor.n_rows());
  products_.require(n_groups * (n_groups + 1) / 2 * width * width);
  free_changes_.require(n_padded);
  factors_.require(n_padded);
}

void Compliance::group_rows(const SupernodalFactor &factor, const SparseRows &rows)
{
  const int n_rows = rows.size();
  n_groups_ = kernels::padded(n_rows) / width;
  first_supernode_.assign(n_rows, factor.n_supernodes());
  for (int row = 0; row < n_rows; ++row)
    for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
      first_supernode_[row] = std::min(first_supernode_[row], factor.supernode_of(rows.columns[k]));
  order_.resize(n_rows);
  place_.resize(n_rows);
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(),
            [this](int a, int b) {
              return first_supernode_[a] < first_supernode_[b] || (first_supernode_[a] == first_supernode_[b] && a < b);
            });
  for (int place = 0; place < n_rows; ++place)
    place_[order_[place]] = place;
}

void Compliance::mark_reach(const SupernodalFactor &factor, const SparseRows &rows)
{
  reached_by_.resize(factor.n_supernodes());
  for (std::vector<int> &reached : reached_by_)
    reached.clear();
  last_group_seen_.assign(factor.n_supernodes(), -1);
  for (std::size_t place = 0; place < order_.size(); ++place)
  {
    const int row = order_[place], group = static_cast<int>(place) / width;
    for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
      for (int s = factor.supernode_of(rows.columns[k]); s >= 0 && last_group_seen_[s] != group; s = factor.parent(s))
      {
        last_group_seen_[s] = group;
        reached_by_[s].push_back(group);
      }
  }
}

void Compliance::set_right_sides(const SupernodalFactor &factor, const SparseRows &rows)
{
  const std::size_t group_size = static_cast<std::size_t>(factor.n_rows()) * width;
  right_sides_.require(n_groups_ * group_size);
  products_.require(static_cast<std::size_t>(n_groups_) * (n_groups_ + 1) / 2 * width * width);
  free_changes_.require(n_groups_ * width);
  factors_.require(n_groups_ * width);
  std::fill_n(products_.data(), static_cast<std::size_t>(n_groups_) * (n_groups_ + 1) / 2 * width * width, 0.0);
  std::fill_n(free_changes_.data(), n_groups_ * width, 0.0);
  std::fill_n(factors_.data(), n_groups_ * width, 0.0);
  group_values_.resize(n_groups_);
  for (int group = 0; group < n_groups_; ++group)
    group_values_[group] = right_sides_.data() + group * group_size;
  for (int s = 0; s < factor.n_supernodes(); ++s)
    for (const int group : reached_by_[s])
      std::fill_n(group_values_[group] + factor.first_column(s) * width, factor.columns(s).n_columns * width, 0.0);
  for (std::size_t place = 0; place < order_.size(); ++place)
    for (int k = rows.starts[order_[place]]; k < rows.starts[order_[place] + 1]; ++k)
      group_values_[place / width][rows.columns[k] * width + place % width] += rows.values[k];
}

kernels::RightSides Compliance::sides_at(int supernode) const
{
  const std::vector<int> &groups = reached_by_[supernode];
  return {group_values_.data(), groups.data(), static_cast<int>(groups.size())};
}

void Compliance::set_result()
{
  const int n_rows = static_cast<int>(order_.size());
  if (const auto size = static_cast<std::size_t>(n_rows) * n_rows; result_.size() < size)
    result_.resize(size);
  for (int column = 0; column < n_rows; ++column)
    for (int row = column; row < n_rows; ++row)
    {
      const int a = std::max(place_[row], place_[column]), b = std::min(place_[row], place_[column]);
      const long tile = static_cast<long>(a / width) * (a / width + 1) / 2 + b / width;
      result_[static_cast<std::size_t>(column) * n_rows + row] =
          products_.data()[(tile * width + b % width) * width + a % width];
    }
}

void Compliance::add_combination(const SupernodalFactor &factor, Eigen::VectorXd &x) const
{
  for (int s = 0; s < factor.n_supernodes(); ++s)
    if (const kernels::RightSides sides = sides_at(s); sides.n_groups > 0)
      factor.kernels().add_combination(factor.first_column(s), factor.columns(s).n_columns, sides, factors_.data(),
                                       x.data());
}
} // namespace pelvireg::registration
