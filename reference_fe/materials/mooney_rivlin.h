// Mooney-Rivlin: W = C10 (I1bar - 3) + C01 (I2bar - 3) + kappa/2 (J - 1)^2.
#pragma once

#include "reference_fe/materials/invariant_law.h"

namespace pelvireg::reference_fe
{
/// Coefficients in MPa; initial shear modulus 2 (C10 + C01).
class MooneyRivlin : public InvariantLaw
{
public:
  MooneyRivlin(double c10, double c01, double kappa) : InvariantLaw(kappa), c10_(c10), c01_(c01) {}

protected:
  IsochoricEnergy isochoric(double i1bar, double i2bar) const override
  {
    IsochoricEnergy w;
    w.value = c10_ * (i1bar - 3) + c01_ * (i2bar - 3);
    w.d1 = c10_;
    w.d2 = c01_;
    return w;
  }

private:
  double c10_, c01_;
};
} // namespace pelvireg::reference_fe
