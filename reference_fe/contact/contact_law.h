// The traction of frictionless penalty contact as a function of the gap.
#pragma once

namespace pelvireg::reference_fe
{
/// Contact law: traction t(g)/penalty = (g0 - g)^2 / (4 g0) for |g| < g0, -g below, 0 above; energy and its derivatives
/// per area and penalty. Traction and slope are continuous; the linear law is reached at depth g0.
struct ContactLaw
{
  double energy = 0, d_energy = 0, d2_energy = 0;
};

/// @param gap g, mm. @param onset g0, mm.
ContactLaw contact_law(double gap, double onset);
} // namespace pelvireg::reference_fe
