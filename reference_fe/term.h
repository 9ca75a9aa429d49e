// One kind of contribution to the equilibrium equations: shell, solid, bar, pressure, cavity, contact, tie, probe.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Local arrays of one item of a term. `residual` is internal minus external force (N; mm^3 for a cavity row);
/// `tangent` is its derivative with respect to the unknowns listed in `unknowns`. Not necessarily symmetric.
struct LocalSystem
{
  std::vector<int> unknowns; ///< global indices, n
  Eigen::VectorXd residual;  ///< n
  Eigen::MatrixXd tangent;   ///< n x n; empty when it is zero
  double energy = 0;         ///< N mm; 0 for a term that has none
  bool with_tangent = true;  ///< set by the assembler; when false, `tangent` is not read and need not be filled
};

/// A sum of items, each touching few unknowns. The assembler calls update() once before every assembly (alone), then
/// evaluate() for all items (concurrently, so it must be const and write only to `local`), and adds the results in
/// item order: the same bytes for every number of threads.
class Term
{
public:
  virtual ~Term() = default;

  virtual std::string name() const = 0;
  virtual int n_items() const = 0;

  /// Look at the current unknowns before an assembly (contact search). Returns true when items or the unknowns they
  /// touch have changed, so that the sparsity pattern must be rebuilt.
  virtual bool update(const Eigen::VectorXd & /*solution*/) { return false; }

  /// Global unknowns of one item, for the sparsity pattern.
  virtual void unknowns(int item, std::vector<int> &indices) const = 0;

  /// Residual, tangent and energy of one item at `solution` (all global unknowns).
  virtual void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const = 0;

  /// Newton's method linearises at `solution`, the last accepted iterate; trials that follow may be thrown away.
  virtual void linearise_at(const Eigen::VectorXd & /*solution*/) {}

  /// A step has been accepted (true) or thrown away (false): keep or drop history.
  virtual void end_step(bool /*accepted*/) {}
};
} // namespace pelvireg::reference_fe
