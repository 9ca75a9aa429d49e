#include "reference_fe/equilibrium_system.h"

#include "synthetic/dataset/error.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <thread>

namespace pelvireg::reference_fe
{
namespace
{
// Local tangents of one chunk stay in the second-level cache: 64 shell cells of 63 unknowns are 2 MB.
constexpr int chunk_size = 64;
} // namespace

EquilibriumSystem::EquilibriumSystem(int n_threads) : n_threads_(std::max(1, n_threads)), chunk_(chunk_size) {}

int EquilibriumSystem::add_unknowns(int count, const UnknownGroup &group)
{
  UnknownGroup added = group;
  added.first = n_unknowns();
  added.count = count;
  groups_.push_back(added);
  is_fixed_.resize(is_fixed_.size() + count, 0);
  residual_scale_.resize(is_fixed_.size(), group.residual_scale);
  pattern_is_current_ = false;
  return added.first;
}

void EquilibriumSystem::add_term(std::shared_ptr<Term> term)
{
  terms_.push_back(std::move(term));
  pattern_is_current_ = false;
}

void EquilibriumSystem::fix(int unknown)
{
  pattern_is_current_ = pattern_is_current_ && is_fixed_.at(unknown);
  is_fixed_.at(unknown) = 1;
}

void EquilibriumSystem::release(int unknown)
{
  pattern_is_current_ = pattern_is_current_ && !is_fixed_.at(unknown);
  is_fixed_.at(unknown) = 0;
}

int EquilibriumSystem::n_free() const
{
  return static_cast<int>(std::count(is_fixed_.begin(), is_fixed_.end(), 0));
}

void EquilibriumSystem::assemble(const Eigen::VectorXd &solution, bool with_tangent)
{
  update_terms(solution);
  if (!pattern_is_current_)
    build_pattern();

  residual_ = Eigen::VectorXd::Zero(n_unknowns());
  term_energies_.assign(terms_.size(), 0.0);
  if (with_tangent)
    std::fill(tangent_.value.begin(), tangent_.value.end(), 0.0);

  for (std::size_t term = 0; term < terms_.size(); ++term)
  {
    const int n_items = terms_[term]->n_items();
    for (int begin = 0; begin < n_items; begin += chunk_size)
    {
      const int end = std::min(begin + chunk_size, n_items);
      evaluate_chunk(*terms_[term], begin, end, solution, with_tangent);
      for (int item = begin; item < end; ++item)
        add_item(term, item, chunk_[item - begin], with_tangent);
    }
  }
}

void EquilibriumSystem::update_terms(const Eigen::VectorXd &solution)
{
  if (solution.size() != n_unknowns())
    throw ComputationError("the solution has " + std::to_string(solution.size()) + " entries, the system " +
                           std::to_string(n_unknowns()) + " unknowns");
  for (const auto &term : terms_)
    if (term->update(solution))
      pattern_is_current_ = false;
}

void EquilibriumSystem::evaluate_chunk(const Term &term, int begin, int end, const Eigen::VectorXd &solution,
                                       bool with_tangent)
{
  const auto evaluate_every = [&](int first, int stride)
  {
    for (int item = begin + first; item < end; item += stride)
    {
      chunk_[item - begin].with_tangent = with_tangent;
      term.evaluate(item, solution, chunk_[item - begin]);
    }
  };
  const int n_threads = std::min(n_threads_, end - begin);
  if (n_threads == 1)
    return evaluate_every(0, 1);

  std::vector<std::exception_ptr> failure(n_threads);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < n_threads; ++t)
      threads.emplace_back(
          [&, t]
          {
            try
            {
              evaluate_every(t, n_threads);
            }
            catch (...)
            {
              failure[t] = std::current_exception();
            }
          });
  }
  for (const auto &e : failure)
    if (e)
      std::rethrow_exception(e);
}

void EquilibriumSystem::add_item(std::size_t term, int item, const LocalSystem &local, bool with_tangent)
{
  const std::size_t index = first_item_[term] + item;
  const std::size_t begin = unknown_start_[index];
  const int n = static_cast<int>(unknown_start_[index + 1] - begin);
  if (local.residual.size() != n)
    throw ComputationError("item " + std::to_string(item) + " of term '" + terms_[term]->name() + "' gave " +
                           std::to_string(local.residual.size()) + " rows for " + std::to_string(n) + " unknowns");
  for (int i = 0; i < n; ++i)
    residual_[item_unknown_[begin + i]] += local.residual[i];
  term_energies_[term] += local.energy;
  if (!with_tangent)
    return;
  const int *location = location_.data() + location_start_[index];
  const double *entry = local.tangent.data();
  for (int k = 0; k < n * n; ++k)
    if (location[k] >= 0)
      tangent_.value[location[k]] += entry[k];
}

double EquilibriumSystem::energy() const
{
  return std::accumulate(term_energies_.begin(), term_energies_.end(), 0.0);
}

double EquilibriumSystem::residual_norm() const
{
  double largest = 0;
  for (int i = 0; i < n_unknowns(); ++i)
  {
    if (!std::isfinite(residual_[i]))
      return std::numeric_limits<double>::quiet_NaN();
    if (!is_fixed_[i])
      largest = std::max(largest, std::abs(residual_[i]) / residual_scale_[i]);
  }
  return largest;
}

double EquilibriumSystem::residual_merit() const
{
  double sum = 0;
  for (int i = 0; i < n_unknowns(); ++i)
    if (!is_fixed_[i])
      sum += (residual_[i] / residual_scale_[i]) * (residual_[i] / residual_scale_[i]);
  return std::sqrt(sum);
}

std::string EquilibriumSystem::worst_row() const
{
  int worst = -1;
  double largest = -1;
  for (int i = 0; i < n_unknowns(); ++i)
    if (!is_fixed_[i] && !(std::abs(residual_[i]) / residual_scale_[i] <= largest))
    {
      worst = i;
      largest = std::abs(residual_[i]) / residual_scale_[i];
    }
  for (const UnknownGroup &group : groups_)
    if (worst >= group.first && worst < group.first + group.count)
      return group.name + " " + std::to_string(worst - group.first);
  return "none";
}

bool EquilibriumSystem::factorise()
{
  if (!analysed_)
    lu_.analyse(tangent_);
  analysed_ = true;
  return lu_.factorise(tangent_);
}

Eigen::VectorXd EquilibriumSystem::solve(const Eigen::VectorXd &rhs) const
{
  Eigen::VectorXd free_rhs(tangent_.n);
  for (int i = 0; i < n_unknowns(); ++i)
    if (free_index_[i] >= 0)
      free_rhs[free_index_[i]] = rhs[i];
  const Eigen::VectorXd free_x = lu_.solve(tangent_, free_rhs);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n_unknowns());
  for (int i = 0; i < n_unknowns(); ++i)
    if (free_index_[i] >= 0)
      x[i] = free_x[free_index_[i]];
  return x;
}

void EquilibriumSystem::linearise_at(const Eigen::VectorXd &solution)
{
  for (const auto &term : terms_)
    term->linearise_at(solution);
}

void EquilibriumSystem::end_step(bool accepted)
{
  for (const auto &term : terms_)
    term->end_step(accepted);
}

// --- sparsity pattern -----------------------------------------------------------------------------------------------

void EquilibriumSystem::build_pattern()
{
  number_free_unknowns();
  collect_items();
  // Items of every free unknown, so that each column is the union of few short lists.
  std::vector<std::vector<int>> items_of(tangent_.n);
  const int n_items = static_cast<int>(unknown_start_.size()) - 1;
  for (int item = 0; item < n_items; ++item)
    for (std::size_t k = unknown_start_[item]; k < unknown_start_[item + 1]; ++k)
      if (const int column = free_index_[item_unknown_[k]]; column >= 0)
        items_of[column].push_back(item);

  std::vector<int> last_column(tangent_.n, -1);
  tangent_.column_start.assign(1, 0);
  tangent_.row.clear();
  for (int column = 0; column < tangent_.n; ++column)
  {
    // A diagonal entry everywhere: saddle-point rows have none of their own.
    last_column[column] = column;
    tangent_.row.push_back(column);
    for (const int item : items_of[column])
      for (std::size_t k = unknown_start_[item]; k < unknown_start_[item + 1]; ++k)
        if (const int row = free_index_[item_unknown_[k]]; row >= 0 && last_column[row] != column)
        {
          last_column[row] = column;
          tangent_.row.push_back(row);
        }
    std::sort(tangent_.row.begin() + tangent_.column_start.back(), tangent_.row.end());
    tangent_.column_start.push_back(static_cast<int>(tangent_.row.size()));
  }
  tangent_.value.assign(tangent_.row.size(), 0.0);
  locate_entries();
  pattern_is_current_ = true;
  analysed_ = false;
  ++n_patterns_built_;
}

void EquilibriumSystem::number_free_unknowns()
{
  free_index_.assign(n_unknowns(), -1);
  tangent_.n = 0;
  for (int i = 0; i < n_unknowns(); ++i)
    if (!is_fixed_[i])
      free_index_[i] = tangent_.n++;
}

void EquilibriumSystem::collect_items()
{
  first_item_.assign(1, 0);
  unknown_start_.assign(1, 0);
  item_unknown_.clear();
  std::vector<int> indices;
  for (const auto &term : terms_)
  {
    for (int item = 0; item < term->n_items(); ++item)
    {
      indices.clear();
      term->unknowns(item, indices);
      item_unknown_.insert(item_unknown_.end(), indices.begin(), indices.end());
      unknown_start_.push_back(item_unknown_.size());
    }
    first_item_.push_back(unknown_start_.size() - 1);
  }
}

void EquilibriumSystem::locate_entries()
{
  location_start_.assign(1, 0);
  location_.clear();
  for (std::size_t item = 0; item + 1 < unknown_start_.size(); ++item)
  {
    const int *unknown = item_unknown_.data() + unknown_start_[item];
    const int n = static_cast<int>(unknown_start_[item + 1] - unknown_start_[item]);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const int row = free_index_[unknown[i]], column = free_index_[unknown[j]];
        if (row < 0 || column < 0)
        {
          location_.push_back(-1);
          continue;
        }
        const auto begin = tangent_.row.begin() + tangent_.column_start[column];
        const auto end = tangent_.row.begin() + tangent_.column_start[column + 1];
        location_.push_back(static_cast<int>(std::lower_bound(begin, end, row) - tangent_.row.begin()));
      }
    location_start_.push_back(location_.size());
  }
}
} // namespace pelvireg::reference_fe
