// One unknown takes a given value; the load factor that brings it there is an unknown of the system.
#pragma once

#include "reference_fe/term.h"

#include <string>

namespace pelvireg::reference_fe
{
/// Row of the load factor: controlled unknown - target = 0. Passes limit points at which load control stops.
class DisplacementControl : public Term
{
public:
  DisplacementControl(int controlled_unknown, int factor_unknown)
      : controlled_unknown_(controlled_unknown), factor_unknown_(factor_unknown)
  {
  }
  void set_target(double value) { target_ = value; }

  std::string name() const override { return "displacement control"; }
  int n_items() const override { return 1; }
  void unknowns(int, std::vector<int> &indices) const override { indices = {factor_unknown_, controlled_unknown_}; }
  void evaluate(int, const Eigen::VectorXd &solution, LocalSystem &local) const override
  {
    local.residual = Eigen::Vector2d(solution[controlled_unknown_] - target_, 0);
    local.tangent = (Eigen::Matrix2d() << 0, 1, 0, 0).finished();
    local.energy = 0;
  }

private:
  int controlled_unknown_, factor_unknown_;
  double target_ = 0;
};
} // namespace pelvireg::reference_fe
