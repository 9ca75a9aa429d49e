// From solutions to truth.h5.
#pragma once

#include "reference_fe/force_balance.h"
#include "reference_fe/load_stepper.h"
#include "reference_fe/pelvis_model.h"
#include "synthetic/dataset/truth.h"

namespace pelvireg::reference_fe
{
/// Collects the outer surfaces (organs in the order of every table, then the pelvic floor, then other parts), the bars
/// and the record of each increment.
class TruthRecorder
{
public:
  TruthRecorder(const PelvisModel &model, const std::string &case_name);

  /// A converged increment, at which the system was assembled last.
  void record(const Eigen::VectorXd &solution, const StepEffort &effort, const PathWork &work);
  const dataset::Truth &truth() const { return truth_; }

private:
  dataset::BalanceRecord balance(const Eigen::VectorXd &solution, const PathWork &work) const;

  const PelvisModel &model_;
  std::vector<const OuterSurface *> surfaces_; ///< in the order of the truth
  ForceBalance forces_;
  std::vector<std::string> bar_groups_; ///< in the order of their first bars
  dataset::Truth truth_;
};
} // namespace pelvireg::reference_fe
