// Which support carries what.
#pragma once

#include "reference_fe/pelvis_model.h"

#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Forces from outside on the pelvis: the abdominal pressure, the held nodes of each part and the far ends of each
/// group of bars. Contact, ties, fluids and bars between parts act within it and cancel.
class ForceBalance
{
public:
  explicit ForceBalance(const PelvisModel &model);

  /// "nodes of PART", then "bars GROUP".
  const std::vector<std::string> &supports() const { return names_; }
  /// r x 3, N, on the pelvis. The system's last assembly must have been at `solution`.
  dataset::Points reactions(const Eigen::VectorXd &solution) const;
  /// N, on the pelvis.
  Eigen::Vector3d pressure_resultant(const Eigen::VectorXd &solution) const;

private:
  const PelvisModel &model_;
  std::vector<std::string> names_;
};
} // namespace pelvireg::reference_fe
