// Closed forms of incompressible hyperelastic walls: Ogden, Non-Linear Elastic Deformations (1984),
// sections 5.3.1, 5.3.2.
#pragma once

#include <cmath>
#include <functional>

namespace pelvireg::reference_fe
{
/// W = C10 (I1 - 3) + C01 (I2 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3, MPa.
struct IncompressibleEnergy
{
  double c10 = 0, c01 = 0, c20 = 0, c30 = 0;

  double mu() const { return 2 * (c10 + c01); }
  /// Difference of two principal Cauchy stresses, MPa; `third` is the remaining stretch.
  double stress_difference(double first, double second, double third) const
  {
    const double x = first * first + second * second + third * third - 3;
    const double w1 = c10 + 2 * c20 * x + 3 * c30 * x * x;
    return 2 * w1 * (first * first - second * second) - 2 * c01 * (1 / (first * first) - 1 / (second * second));
  }
};

/// int_from^to f by Simpson's rule.
inline double integral(double from, double to, const std::function<double(double)> &f)
{
  const int n = 200;
  const double h = (to - from) / n;
  double sum = f(from) + f(to);
  for (int i = 1; i < n; ++i)
    sum += (i % 2 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

/// Pressure in a sphere of rest radii a, b whose inner face is stretched: p = 2 int (sigma_t - sigma_r) / r dr.
inline double sphere_pressure(const IncompressibleEnergy &energy, double stretch, double a, double b)
{
  const double swept = a * a * a * (stretch * stretch * stretch - 1); // r^3 - R^3
  return integral(a, b,
                  [&](double rest)
                  {
                    const double r = std::cbrt(rest * rest * rest + swept), l = r / rest;
                    return 2 * energy.stress_difference(l, 1 / (l * l), l) / r * rest * rest / (r * r);
                  });
}

struct TubeState
{
  double axial_stretch = 1, pressure = 0; ///< MPa
};

/// A tube of rest radii a, b with closed ends whose inner face is stretched by `stretch` around: the axial stretch at
/// which the lids' pressure is carried, int (sigma_z - (sigma_t + sigma_r) / 2) r dr = 0, and p = int (sigma_t -
/// sigma_r) / r dr.
inline TubeState closed_tube(const IncompressibleEnergy &energy, double stretch, double a, double b)
{
  const auto over_wall = [&](double axial, auto integrand)
  {
    return integral(a, b,
                    [&](double rest)
                    {
                      const double r = std::sqrt(stretch * stretch * a * a + (rest * rest - a * a) / axial);
                      const double around = r / rest;
                      return integrand(r, around, 1 / (around * axial)) * rest / (axial * r); // dr
                    });
  };
  const auto axial_force = [&](double axial)
  {
    return over_wall(axial,
                     [&](double r, double around, double through)
                     {
                       return r / 2 *
                              (energy.stress_difference(axial, around, through) +
                               energy.stress_difference(axial, through, around));
                     });
  };
  double low = 0.5, high = 3;
  for (int i = 0; i < 60; ++i)
    (axial_force(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  const double pressure = over_wall(low, [&](double r, double around, double through)
                                    { return energy.stress_difference(around, through, low) / r; });
  return {low, pressure};
}
} // namespace pelvireg::reference_fe
