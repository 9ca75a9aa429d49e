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
  items_.emplace_back();
  items_changed_.push_back(1);
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
  refresh_pattern();

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
  for (std::size_t term = 0; term < terms_.size(); ++term)
    if (terms_[term]->update(solution))
      items_changed_[term] = 1;
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
  const int n = items_[term].n_unknowns(item);
  if (local.residual.size() != n)
    throw ComputationError("item " + std::to_string(item) + " of term '" + terms_[term]->name() + "' gave " +
                           std::to_string(local.residual.size()) + " rows for " + std::to_string(n) + " unknowns");
  const int *unknown = items_[term].unknowns(item);
  for (int i = 0; i < n; ++i)
    residual_[unknown[i]] += local.residual[i];
  term_energies_[term] += local.energy;
  if (!with_tangent || local.tangent.size() == 0)
    return;
  const int *location = items_[term].locations(item);
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
  for (int i = 0; i < n_unknowns() && std::isfinite(largest); ++i)
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
  const Eigen::VectorXd free_x = lu_.solve(free_rhs);
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

void EquilibriumSystem::refresh_pattern()
{
  bool is_complete = pattern_is_current_;
  if (!pattern_is_current_)
  {
    number_free_unknowns();
    std::fill(items_changed_.begin(), items_changed_.end(), 1);
  }
  for (std::size_t term = 0; term < terms_.size(); ++term)
    if (items_changed_[term])
    {
      items_[term].collect(*terms_[term]);
      is_complete = is_complete && items_[term].locate(tangent_, free_index_);
      items_changed_[term] = 0;
    }
  if (is_complete)
    return;
  const int n_free_unknowns = n_free();
  tangent_ = joined_pattern(items_, free_index_, n_free_unknowns, pattern_is_current_ ? tangent_ : SparseMatrix{});
  for (ItemPattern &items : items_)
    items.locate(tangent_, free_index_);
  pattern_is_current_ = true;
  analysed_ = false;
  ++n_patterns_built_;
}

void EquilibriumSystem::number_free_unknowns()
{
  free_index_.assign(n_unknowns(), -1);
  int n = 0;
  for (int i = 0; i < n_unknowns(); ++i)
    if (!is_fixed_[i])
      free_index_[i] = n++;
}

} // namespace pelvireg::reference_fe
