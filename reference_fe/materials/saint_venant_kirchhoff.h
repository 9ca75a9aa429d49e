// St. Venant-Kirchhoff: W = lambda/2 (tr E)^2 + mu E : E, for the published shell tables.
#pragma once

#include "reference_fe/materials/hyperelastic_law.h"

namespace pelvireg::reference_fe
{
/// Young's modulus in MPa and Poisson's ratio in (-1, 0.5).
class SaintVenantKirchhoff : public HyperelasticLaw
{
public:
  SaintVenantKirchhoff(double youngs_modulus, double poisson_ratio)
  {
    const double mu = youngs_modulus / (2 * (1 + poisson_ratio));
    const double lambda = youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
    tangent_.setZero();
    tangent_.topLeftCorner<3, 3>().setConstant(lambda);
    tangent_.diagonal().head<3>().array() += 2 * mu;
    tangent_.diagonal().tail<3>().array() = mu;
  }
  StressState evaluate(const Voigt &green_lagrange) const override
  {
    StressState state;
    state.tangent = tangent_;
    state.stress = tangent_ * green_lagrange;
    state.energy = 0.5 * green_lagrange.dot(state.stress);
    return state;
  }

private:
  VoigtMatrix tangent_;
};
} // namespace pelvireg::reference_fe
