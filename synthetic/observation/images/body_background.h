// What surrounds the organs: fat, muscle, bowel, bone, skin, air. Scenery with the proportions of the anatomy, no part
// of the truth.
#pragma once

#include "synthetic/observation/images/tissue_signals.h"

#include <Eigen/Core>

namespace pelvireg::observation
{
/// What does not move at a point in space. Shares of the tissue there.
struct FixedScenery
{
  double inside = 0;      ///< of the body; the rest is air
  double bone = 0;        ///< of the inside
  double bone_signal = 0; ///< of that bone
  double skin_depth = 0;  ///< mm under the skin, for fat and muscle layers
};

/// `position`: LPS, mm, origin at the inferior pubic point.
FixedScenery fixed_scenery(const Eigen::Vector3d &position, const TissueSignals &signals);

/// Signal of the soft tissue whose rest position is `material`, textured: it moves with the tissue.
double soft_tissue(const Eigen::Vector3d &material, double skin_depth, const TissueSignals &signals);
} // namespace pelvireg::observation
