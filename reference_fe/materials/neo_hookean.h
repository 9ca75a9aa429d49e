// Neo-Hookean: W = C10 (I1bar - 3) + kappa/2 (J - 1)^2.
#pragma once

#include "reference_fe/materials/invariant_law.h"

namespace pelvireg::reference_fe
{
/// C10 = mu/2 in MPa.
class NeoHookean : public InvariantLaw
{
public:
  NeoHookean(double c10, double kappa) : InvariantLaw(kappa), c10_(c10) {}

protected:
  IsochoricEnergy isochoric(double i1bar, double) const override
  {
    IsochoricEnergy w;
    w.value = c10_ * (i1bar - 3);
    w.d1 = c10_;
    return w;
  }

private:
  double c10_;
};
} // namespace pelvireg::reference_fe
