// Yeoh: W = C10 (I1bar - 3) + C20 (I1bar - 3)^2 + C30 (I1bar - 3)^3 + kappa/2 (J - 1)^2.
#pragma once

#include "reference_fe/materials/invariant_law.h"

namespace pelvireg::reference_fe
{
/// Coefficients in MPa. Initial shear modulus 2 C10. Source: Yeoh, Rubber Chem. Technol. 66 (1993) 754.
class Yeoh : public InvariantLaw
{
public:
  Yeoh(double c10, double c20, double c30, double kappa) : InvariantLaw(kappa), c10_(c10), c20_(c20), c30_(c30) {}

protected:
  IsochoricEnergy isochoric(double i1bar, double) const override
  {
    const double x = i1bar - 3;
    IsochoricEnergy w;
    w.value = x * (c10_ + x * (c20_ + x * c30_));
    w.d1 = c10_ + x * (2 * c20_ + x * 3 * c30_);
    w.d11 = 2 * c20_ + 6 * c30_ * x;
    return w;
  }

private:
  double c10_, c20_, c30_;
};
} // namespace pelvireg::reference_fe
