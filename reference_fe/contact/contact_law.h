// The traction of frictionless penalty contact as a function of the gap.
#pragma once

namespace pelvireg::reference_fe
{
/// Contact law: traction t(g)/penalty = (g0 - g)^2 / (4 g0) for |g| < g0, -g below, 0 above; where the surfaces
/// penetrate (g < 0) s g^2 more, so that an edge that bears on a soft wall does not sink in. Energy and its derivatives
/// per area and penalty. Traction and slope are continuous.
struct ContactLaw
{
  double energy = 0, d_energy = 0, d2_energy = 0;
};

/// @param gap g, mm. @param onset g0, mm. @param stiffening s, 1/mm.
ContactLaw contact_law(double gap, double onset, double stiffening);
} // namespace pelvireg::reference_fe
