// A sphere of shell cells in a system, and its closed form.
#pragma once

#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/yeoh.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// W = C10 (I1 - 3) + C20 (I1 - 3)^2, MPa.
struct YeohCoefficients
{
  double c10 = 0, c20 = 0;
};

/// Inner minus outer pressure of an incompressible thick sphere of rest radii a, b at the stretch of its inner face:
/// int W'(lambda) / (lambda^3 - 1) dlambda from the outer to the inner stretch (Ogden, Non-Linear Elastic Deformations,
/// 1984, section 5.3.2), by Simpson's rule.
inline double sphere_pressure(double stretch, double a, double b, const YeohCoefficients &c)
{
  const auto integrand = [&](double l)
  {
    const double x = 2 * l * l + std::pow(l, -4) - 3;
    const double slope = (c.c10 + 2 * c.c20 * x) * 4 * (l - std::pow(l, -5));
    return slope / (l * l * l - 1);
  };
  const double outer = std::cbrt(b * b * b + a * a * a * (stretch * stretch * stretch - 1)) / b;
  const int n = 200;
  const double h = (stretch - outer) / n;
  double sum = integrand(outer) + integrand(stretch);
  for (int i = 1; i < n; ++i)
    sum += (i % 2 ? 4 : 2) * integrand(outer + i * h);
  return sum * h / 3;
}

/// The same for a bulk modulus kappa, to first order in 1/kappa: the wall swells by p v_cavity / (v_wall kappa) (virial
/// theorem: its mean stress is p v_cavity / v_wall), and the law sees the stretches from the swollen wall.
inline double sphere_pressure(double stretch, double a, double b, const YeohCoefficients &c, double kappa)
{
  const double v_cavity = std::pow(a * stretch, 3), v_wall = b * b * b - a * a * a;
  double pressure = sphere_pressure(stretch, a, b, c);
  for (int i = 0; i < 3; ++i)
  {
    const double j = 1 + pressure * v_cavity / (v_wall * kappa), swell = std::cbrt(j);
    pressure = sphere_pressure(stretch / swell, a * swell, b * swell, c) / j;
  }
  return pressure;
}

/// One sphere; nodes on the axes move along them: no rigid motion is left, and nothing is forced.
struct Sphere
{
  dataset::ReferenceShell shell;
  int first = 0; ///< its first unknown

  /// n x n cells on each of the six sides; kappa/mu = 1000.
  Sphere(EquilibriumSystem &system, int n, double radius, double thickness, const YeohCoefficients &c)
      : shell(sphere_shell(n, radius, thickness))
  {
    const ShellBody body = shell_body(shell);
    first = add_shell_unknowns(system, body);
    const auto law = std::make_shared<Yeoh>(c.c10, c.c20, 0, kappa(c));
    system.add_term(std::make_shared<ShellTerm>(body, law, first));
    for (int node = 0; node < n_nodes(); ++node)
      if (shell.midsurface.row(node).normalized().cwiseAbs().maxCoeff() > 1 - 1e-12)
        for (int k = 0; k < 3; ++k)
          if (std::abs(shell.midsurface(node, k)) < 1e-9)
            system.fix(first + n_shell_unknowns * node + k);
  }

  static double kappa(const YeohCoefficients &c) { return 2000 * c.c10; }
  int n_nodes() const { return static_cast<int>(shell.midsurface.rows()); }
  /// All faces of one side (+1, -1), outward.
  std::vector<SurfaceFace> faces(int side) const
  {
    std::vector<SurfaceFace> all;
    for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
      all.push_back(shell_face(shell, first, c, side));
    return all;
  }
  /// Distance of each node's outer or inner face from the centre, mm.
  Eigen::VectorXd radii(const Eigen::VectorXd &solution, int side) const
  {
    Eigen::VectorXd r(n_nodes());
    for (int node = 0; node < n_nodes(); ++node)
      r[node] = shell_node(shell, first, node, side).position(solution).norm();
    return r;
  }
};
} // namespace pelvireg::reference_fe
