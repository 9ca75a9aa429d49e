// Isotropic linear elasticity of the element frame.
#pragma once

namespace pelvireg::registration
{
/// Lamé constants, MPa.
struct Lame
{
  double lambda = 0;
  double mu = 0;
};

/// From Young's modulus (MPa, > 0) and Poisson's ratio (-1 < nu < 0.5).
inline Lame lame_constants(double youngs_modulus, double poisson_ratio)
{
  return {youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)),
          youngs_modulus / (2 * (1 + poisson_ratio))};
}
} // namespace pelvireg::registration
