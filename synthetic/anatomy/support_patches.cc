#include "synthetic/anatomy/organs.h"

namespace pelvireg::anatomy
{
using Eigen::Vector3d;

SupportPatches support_patches(const Support &support, bool left, const Parameters &parameters)
{
  const Vector3d side(left ? 1 : -1, 1, 1);
  SupportPatches patches = {support.organ_point.cwiseProduct(side), support.organ_span.cwiseProduct(side),
                            support.far_point.cwiseProduct(side), support.far_span.cwiseProduct(side),
                            left ? support.area_left : support.area_right};
  if (support.organ == "uterus")
  {
    const Vector3d centre = cervix_patch(parameters.uterus, parameters.vagina).centre;
    patches.organ_point = deviated(patches.organ_point, centre, parameters.uterus.deviation);
    patches.organ_span = deviated(centre + patches.organ_span, centre, parameters.uterus.deviation) - centre;
  }
  return patches;
}
} // namespace pelvireg::anatomy
