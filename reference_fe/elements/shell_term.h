// The internal forces of one shell.
#pragma once

#include "reference_fe/elements/shell_body.h"
#include "reference_fe/elements/shell_cell.h"
#include "reference_fe/equilibrium_system.h"

#include <memory>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Append the 7 n_nodes unknowns of a shell to the system and return the index of the first; unknown c (0 … 6: u, w,
/// alpha) of node n is first + 7 n + c. Director and stretch rows are moments: their residuals are divided by the mean
/// thickness.
int add_shell_unknowns(EquilibriumSystem &system, const ShellBody &body);

/// One item a cell.
class ShellTerm : public Term
{
public:
  /// `mixed_integration_points`: geometric stiffness from the extrapolated stress; many fewer iterations for thin
  /// shells in bending, little for thick walls.
  /// Throws InputError for a cell whose volume element is not positive.
  ShellTerm(const ShellBody &body, std::shared_ptr<const HyperelasticLaw> law, int first_unknown,
            bool mixed_integration_points = false);

  std::string name() const override { return name_; }
  int n_items() const override { return static_cast<int>(cells_.size()); }
  /// Switch between the mixed integration points and the exact tangent.
  void use_mixed_integration_points(bool use);
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  void linearise_at(const Eigen::VectorXd &solution) override;

  double rest_volume() const; ///< mm^3
  /// Smallest det(dx/dX) of all cells: not positive means folded. The cell it occurs in, when asked for.
  double smallest_jacobian(const Eigen::VectorXd &solution, int *cell = nullptr) const;

private:
  Eigen::VectorXd gather(int item, const Eigen::VectorXd &solution) const;

  std::string name_;
  std::unique_ptr<const ShellReferenceCell> reference_;
  std::shared_ptr<const HyperelasticLaw> law_;
  std::vector<ShellCell> cells_;
  Eigen::MatrixXi unknowns_; ///< 7 n_nodes_a_cell x n_cells
  bool mixed_integration_points_;
  Eigen::VectorXd linearised_at_; ///< last accepted iterate: where mixed integration points extrapolate from
};
} // namespace pelvireg::reference_fe
