// Exact and discrete solutions of planar cantilevers: what the published cantilever tables are measured against.
#pragma once

#include <Eigen/Core>

namespace pelvireg::reference_fe
{
/// Shortening and deflection of the tip.
using TipDisplacement = Eigen::Vector2d;

/// The inextensible elastica under a dead end load: E I theta'' = -P cos(theta), theta(0) = 0, theta'(L) = 0.
TipDisplacement elastica(double load, double length, double bending_stiffness);

/// The same, cut into `n` straight inextensible beams of equal length, their curvature constant, their load integrated
/// at their middle: a row of n two-node shell cells with one integration point when nu = 0.
TipDisplacement straight_beams(double load, double length, double bending_stiffness, int n);

/// The inextensible circle under an end moment, turned by `angle` at its end.
TipDisplacement rolled_up(double angle, double length);

/// A strip of thickness h and width 1 in plane strain, of St. Venant and Kirchhoff's law with nu = 0, rolled up by an
/// end moment: the exact solution of the solid. A point at Z of the wall lies on a circle of radius r(Z),
/// E11 = (k^2 r^2 - 1) / 2, E33 = (r'^2 - 1) / 2, (E33 r')' = k^2 r E11, r' = 1 on both faces.
/// M = E I k (1 - 6 s), the axis is shorter by 1.5 s, s = k^2 h^2 / 12, to first order.
struct RolledStrip
{
  double moment = 0; ///< N mm, per width 1
  double radius = 0; ///< of the mid-surface
};
RolledStrip rolled_strip(double curvature, double thickness, double youngs_modulus);
TipDisplacement rolled_strip_tip(double moment, double length, double thickness, double youngs_modulus);
} // namespace pelvireg::reference_fe
