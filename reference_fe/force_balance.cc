#include "reference_fe/force_balance.h"

#include <algorithm>

namespace pelvireg::reference_fe
{
namespace
{
std::string support_of(const Bar &bar)
{
  return "bars " + bar.group;
}
} // namespace

ForceBalance::ForceBalance(const PelvisModel &model) : model_(model)
{
  for (const HeldNodes &held : model.held_nodes)
    names_.push_back("nodes of " + held.part);
  for (const Bar &bar : model.bars)
    if (bar.nodes.size() == 1 && std::find(names_.begin(), names_.end(), support_of(bar)) == names_.end())
      names_.push_back(support_of(bar));
}

dataset::Points ForceBalance::reactions(const Eigen::VectorXd &solution) const
{
  dataset::Points forces = dataset::Points::Zero(static_cast<Eigen::Index>(names_.size()), 3);
  const Eigen::VectorXd &residual = model_.system.residual();
  for (std::size_t h = 0; h < model_.held_nodes.size(); ++h)
    for (const int first : model_.held_nodes[h].first_unknowns)
      forces.row(static_cast<Eigen::Index>(h)) += residual.segment<3>(first).transpose();
  for (const Bar &bar : model_.bars)
    if (bar.nodes.size() == 1)
    {
      const auto support = std::find(names_.begin(), names_.end(), support_of(bar));
      forces.row(support - names_.begin()) += bar_pull(bar, solution).transpose();
    }
  return forces;
}

Eigen::Vector3d ForceBalance::pressure_resultant(const Eigen::VectorXd &solution) const
{
  return model_.load->resultant(solution);
}
} // namespace pelvireg::reference_fe
