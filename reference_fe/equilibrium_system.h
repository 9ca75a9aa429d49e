// The equilibrium equations R(x) = 0: unknowns, terms, assembly, factorisation.
#pragma once

#include "reference_fe/item_pattern.h"
#include "reference_fe/sparse_lu.h"
#include "reference_fe/sparse_matrix.h"
#include "reference_fe/term.h"

#include <memory>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Unknowns of one meaning: displacement, director, thickness stretch, cavity pressure, load factor, …
struct UnknownGroup
{
  std::string name;
  /// The residual of a row is divided by this before it is compared with the tolerance (in N): 1 for a force row, a
  /// length (mm) for a moment row (N mm), mm^3 per N for a cavity's volume row, mm per N for a displacement row, …
  double residual_scale = 1;
  int first = 0; ///< set by add_unknowns()
  int count = 0; ///< set by add_unknowns()
};

/// Owns the terms, the numbering and the factorisation. Unknowns are numbered in the order of the add_unknowns() calls.
class EquilibriumSystem
{
public:
  explicit EquilibriumSystem(int n_threads = 1);

  /// Append `count` unknowns; returns the index of the first.
  int add_unknowns(int count, const UnknownGroup &group);
  /// Another residual scale for one unknown of a group (the group's is the default).
  void set_residual_scale(int unknown, double scale) { residual_scale_.at(unknown) = scale; }
  void add_term(std::shared_ptr<Term> term);
  /// A fixed unknown keeps whatever value it has in the solution; its row is left out and holds the reaction.
  void fix(int unknown);
  void release(int unknown);

  int n_unknowns() const { return static_cast<int>(is_fixed_.size()); }
  int n_free() const;
  bool is_fixed(int unknown) const { return is_fixed_[unknown]; }
  const std::vector<UnknownGroup> &groups() const { return groups_; }
  const std::vector<std::shared_ptr<Term>> &terms() const { return terms_; }

  /// Residual (internal minus external) and energy at `solution`, and the tangent when asked for. Every term's update()
  /// is called first. Non-finite values are kept: ask residual_norm().
  void assemble(const Eigen::VectorXd &solution, bool with_tangent);
  /// All rows; the rows of fixed unknowns hold the reactions (N, N mm).
  const Eigen::VectorXd &residual() const { return residual_; }
  /// Sum of the energies of all terms at the last assembly, N mm; one number a term in term order.
  double energy() const;
  const std::vector<double> &term_energies() const { return term_energies_; }

  /// Largest |residual / residual_scale| over the free rows, N; NaN when any row is not finite.
  double residual_norm() const;
  /// Root of the sum of squares of the same: a smoother merit for line searches.
  double residual_merit() const;
  /// The free row with the largest scaled residual, or the first that is not finite, in words: "displacement 123".
  std::string worst_row() const;

  /// Factorise the last assembled tangent (free rows and columns). False: singular or not finite.
  bool factorise();
  /// x with K x = rhs over the free rows, K the tangent factorised last, which may be an earlier one than the last
  /// assembled; zero at the fixed unknowns. Both have n_unknowns() entries.
  Eigen::VectorXd solve(const Eigen::VectorXd &rhs) const;
  /// Tangent over the free unknowns, numbered in ascending order of the unknowns (tests, inertia).
  const SparseMatrix &tangent() const { return tangent_; }
  /// How often the sparsity pattern was built or enlarged, and analysed anew. It keeps the entries of pairs that have
  /// parted: contact that comes back, and most that moves on, finds its entries there.
  int n_patterns_built() const { return n_patterns_built_; }
  double n_factor_entries() const { return lu_.n_factor_entries(); }

  /// Tell every term that the next trials start from `solution`.
  void linearise_at(const Eigen::VectorXd &solution);
  /// Tell every term that the step was accepted or thrown away.
  void end_step(bool accepted);

private:
  void update_terms(const Eigen::VectorXd &solution);
  void number_free_unknowns();
  /// Take in the new items of the terms that have changed; build or enlarge the pattern where it lacks their entries.
  void refresh_pattern();
  void evaluate_chunk(const Term &term, int begin, int end, const Eigen::VectorXd &solution, bool with_tangent);
  void add_item(std::size_t term, int item, const LocalSystem &local, bool with_tangent);

  int n_threads_;
  std::vector<UnknownGroup> groups_;
  std::vector<char> is_fixed_;
  std::vector<double> residual_scale_;
  std::vector<std::shared_ptr<Term>> terms_;

  /// False: other unknowns are free, or a term was added; the pattern is made from nothing.
  bool pattern_is_current_ = false;
  bool analysed_ = false;
  int n_patterns_built_ = 0;
  std::vector<int> free_index_;     ///< of every unknown, -1 when fixed
  std::vector<ItemPattern> items_;  ///< of every term
  std::vector<char> items_changed_; ///< of every term, since the last refresh_pattern()

  std::vector<LocalSystem> chunk_;
  Eigen::VectorXd residual_;
  std::vector<double> term_energies_;
  SparseMatrix tangent_;
  SparseLu lu_;
};
} // namespace pelvireg::reference_fe
