// The uterus' layers, which move with it.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "synthetic/observation/images/tissue_signals.h"

#include <vector>

namespace pelvireg::observation
{
/// Myometrium; from 10.5 mm under the surface the junctional zone, from 13.5 mm the endometrium (a corpus is 35 to 45
/// mm thick). The cervix, 20 to 26 mm wide, shows its dark stroma in the middle.
class UterusLayers
{
public:
  /// @param surface rest nodes, n x 3, mm. Depth is taken from the nearest node, on a lattice of 3 mm.
  explicit UterusLayers(const dataset::Points &surface);

  /// Signal at a rest position inside.
  double signal(const Eigen::Vector3d &material, const TissueSignals &signals) const;

private:
  double depth_at(const Eigen::Vector3d &material) const;

  Eigen::Vector3d origin_;
  Eigen::Vector3i size_;
  std::vector<double> depths_; ///< mm
};
} // namespace pelvireg::observation
