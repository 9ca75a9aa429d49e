// Laws of the form W(I1bar, I2bar) + kappa/2 (J - 1)^2 (Abaqus' decoupled form, kappa = 2/D1).
#pragma once

#include "reference_fe/materials/hyperelastic_law.h"

namespace pelvireg::reference_fe
{
/// First and second derivatives of the isochoric energy with respect to I1bar and I2bar, MPa.
struct IsochoricEnergy
{
  double value = 0;
  double d1 = 0, d2 = 0;
  double d11 = 0, d12 = 0, d22 = 0;
};

class InvariantLaw : public HyperelasticLaw
{
public:
  /// kappa: bulk modulus, MPa.
  explicit InvariantLaw(double kappa) : kappa_(kappa) {}
  /// Stress and tangent by the chain rule (Holzapfel, Nonlinear Solid Mechanics, 2000, sections 6.4 and 6.6).
  StressState evaluate(const Voigt &green_lagrange) const override;

protected:
  virtual IsochoricEnergy isochoric(double i1bar, double i2bar) const = 0;

private:
  double kappa_;
};
} // namespace pelvireg::reference_fe
