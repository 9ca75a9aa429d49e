// Forces that keep their direction, scaled by a factor that is given or an unknown.
#pragma once

#include "reference_fe/term.h"

#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// One item a loaded unknown. Energy is -factor * force * unknown for a given factor; 0 when the factor is an unknown.
class DeadLoad : public Term
{
public:
  /// `forces`: (unknown, force in N at factor 1). `factor_unknown`: the unknown that scales them, or -1: set_factor().
  explicit DeadLoad(std::vector<std::pair<int, double>> forces, int factor_unknown = -1)
      : forces_(std::move(forces)), factor_unknown_(factor_unknown)
  {
  }
  void set_factor(double factor) { factor_ = factor; }

  std::string name() const override { return "dead load"; }
  int n_items() const override { return static_cast<int>(forces_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override
  {
    indices = {forces_[item].first};
    if (factor_unknown_ >= 0)
      indices.push_back(factor_unknown_);
  }
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override
  {
    const auto [unknown, force] = forces_[item];
    const bool controlled = factor_unknown_ >= 0;
    const double factor = controlled ? solution[factor_unknown_] : factor_;
    local.residual.setZero(controlled ? 2 : 1);
    local.residual[0] = -factor * force;
    local.tangent.setZero(local.residual.size(), local.residual.size());
    if (controlled)
      local.tangent(0, 1) = -force;
    local.energy = controlled ? 0 : -factor * force * solution[unknown];
  }

private:
  std::vector<std::pair<int, double>> forces_;
  int factor_unknown_;
  double factor_ = 1;
};
} // namespace pelvireg::reference_fe
