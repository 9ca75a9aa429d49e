// From solutions to truth.h5.
#pragma once

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

  /// A converged increment.
  void record(const Eigen::VectorXd &solution, const StepEffort &effort);
  const dataset::Truth &truth() const { return truth_; }

private:
  const PelvisModel &model_;
  std::vector<const OuterSurface *> surfaces_; ///< in the order of the truth
  dataset::Truth truth_;
};
} // namespace pelvireg::reference_fe
