#include "reference_fe/elements/shell_term.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <limits>

namespace pelvireg::reference_fe
{
int add_shell_unknowns(EquilibriumSystem &system, const ShellBody &body)
{
  UnknownGroup group;
  group.name = body.name + " unknown";
  const int first = system.add_unknowns(n_shell_unknowns * body.n_nodes(), group);
  const double length = body.thickness.mean();
  for (int node = 0; node < body.n_nodes(); ++node)
    for (int c = 3; c < n_shell_unknowns; ++c)
      system.set_residual_scale(first + n_shell_unknowns * node + c, length);
  return first;
}

ShellTerm::ShellTerm(const ShellBody &body, std::shared_ptr<const HyperelasticLaw> law, int first_unknown,
                     bool mixed_integration_points)
    : name_(body.name), reference_(std::make_unique<ShellReferenceCell>(body.order)), law_(std::move(law)),
      mixed_integration_points_(mixed_integration_points)
{
  const int n = reference_->n_nodes;
  unknowns_.resize(n_shell_unknowns * n, body.n_cells());
  for (int cell = 0; cell < body.n_cells(); ++cell)
  {
    const Eigen::VectorXi nodes = body.cells.col(cell);
    try
    {
      cells_.emplace_back(*reference_, body.midsurface(Eigen::all, nodes), body.director(Eigen::all, nodes),
                          0.5 * body.thickness(nodes));
    }
    catch (const InputError &error)
    {
      throw InputError(fmt::format("cell {} of shell '{}': {}", cell, body.name, error.what()));
    }
    for (int k = 0; k < n; ++k)
    {
      const int first = first_unknown + n_shell_unknowns * nodes[k];
      for (int c = 0; c < 3; ++c)
      {
        unknowns_(3 * k + c, cell) = first + c;
        unknowns_(3 * n + 3 * k + c, cell) = first + 3 + c;
      }
      unknowns_(6 * n + k, cell) = first + 6;
    }
  }
}

void ShellTerm::use_mixed_integration_points(bool use)
{
  if (use == mixed_integration_points_)
    return;
  mixed_integration_points_ = use;
  linearised_at_.resize(0);
}

void ShellTerm::linearise_at(const Eigen::VectorXd &solution)
{
  if (mixed_integration_points_)
    linearised_at_ = solution;
}

void ShellTerm::unknowns(int item, std::vector<int> &indices) const
{
  indices.assign(unknowns_.col(item).begin(), unknowns_.col(item).end());
}

Eigen::VectorXd ShellTerm::gather(int item, const Eigen::VectorXd &solution) const
{
  return solution(unknowns_.col(item));
}

void ShellTerm::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  if (linearised_at_.size() != solution.size())
    return cells_[item].evaluate(*law_, gather(item, solution), nullptr, local);
  const Eigen::VectorXd previous = gather(item, linearised_at_);
  cells_[item].evaluate(*law_, gather(item, solution), &previous, local);
}

double ShellTerm::rest_volume() const
{
  double volume = 0;
  for (const ShellCell &cell : cells_)
    volume += cell.volume();
  return volume;
}

double ShellTerm::smallest_jacobian(const Eigen::VectorXd &solution, int *cell) const
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int item = 0; item < n_items(); ++item)
    if (const double jacobian = cells_[item].smallest_jacobian(gather(item, solution)); jacobian < smallest)
    {
      smallest = jacobian;
      if (cell)
        *cell = item;
    }
  return smallest;
}
} // namespace pelvireg::reference_fe
