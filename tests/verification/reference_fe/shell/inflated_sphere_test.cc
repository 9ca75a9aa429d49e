// Thick-walled incompressible sphere under inner pressure: p = int W'(lambda) / (lambda^3 - 1) dlambda from lambda_b to
// lambda_a (Ogden, Non-Linear Elastic Deformations, 1984, section 5.3.2).
#include "reference_fe/constraints/follower_pressure.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/yeoh.h"
#include "reference_fe/newton_solver.h"
#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace pelvireg::reference_fe
{
namespace
{
struct Coefficients
{
  double c10, c20, c30;
};

/// Inner pressure at the inner stretch, by Simpson's rule; radii at rest a (inner), b (outer).
double closed_form_pressure(double stretch, double a, double b, const Coefficients &c)
{
  const auto integrand = [&](double l)
  {
    const double x = 2 * l * l + std::pow(l, -4) - 3;
    const double slope = (c.c10 + 2 * c.c20 * x + 3 * c.c30 * x * x) * 4 * (l - std::pow(l, -5));
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

/// Inner faces, oriented along the cells (away from the fluid).
std::vector<SurfaceFace> inner_faces(const ShellBody &body, int first)
{
  std::vector<SurfaceFace> faces(body.n_cells());
  for (int cell = 0; cell < body.n_cells(); ++cell)
  {
    faces[cell].nodes.resize(9);
    for (int k = 0; k < 9; ++k)
    {
      const int node = body.cells(k, cell);
      faces[cell].nodes[fe_q2_from_vtk[k]] = {first + n_shell_unknowns * node, -1, body.midsurface.col(node),
                                              body.director.col(node), 0.5 * body.thickness[node]};
    }
  }
  return faces;
}

/// The nodes on the axes move along them: no rigid motion is left, and nothing is forced.
void hold(EquilibriumSystem &system, const ShellBody &body, int first)
{
  for (int node = 0; node < body.n_nodes(); ++node)
    if (body.midsurface.col(node).normalized().cwiseAbs().maxCoeff() > 1 - 1e-12)
      for (int c = 0; c < 3; ++c)
        if (std::abs(body.midsurface(c, node)) < 1e-9)
          system.fix(first + n_shell_unknowns * node + c);
}

/// Largest relative difference between the applied pressure and the closed form at the inner stretch reached.
double largest_difference(int refinements, double thickness, const Coefficients &c)
{
  const double radius = 40, a = radius - thickness / 2, b = radius + thickness / 2;
  const ShellBody body = sphere_shell(refinements, radius, thickness);

  EquilibriumSystem system;
  const int first = add_shell_unknowns(system, body);
  const int pressure = system.add_unknowns(1, {.name = "pressure"});
  const auto law = std::make_shared<Yeoh>(c.c10, c.c20, c.c30, 2 * c.c10 * 1e4);
  system.add_term(std::make_shared<ShellTerm>(body, law, first));
  system.add_term(std::make_shared<FollowerPressure>(inner_faces(body, first), pressure));
  system.fix(pressure);
  hold(system, body, first);

  Eigen::VectorXd solution = Eigen::VectorXd::Zero(system.n_unknowns());
  double largest = 0;
  for (const double stretch : {1.05, 1.1, 1.15, 1.2})
  {
    solution[pressure] = -closed_form_pressure(stretch, a, b, c); // outward: against the faces' normals
    const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-8});
    EXPECT_TRUE(result.converged()) << result.message;
    double inner = 0;
    for (int node = 0; node < body.n_nodes(); ++node)
      inner += shell_point(body.node(node), solution.segment<7>(first + 7 * node), -1).norm() / body.n_nodes();
    const double reached = inner / a;
    std::cout << fmt::format("  stretch wanted {:.4f}, reached {:.4f}, {} iterations\n", stretch, reached,
                             result.iterations.size());
    largest = std::max(largest, std::abs(-solution[pressure] / closed_form_pressure(reached, a, b, c) - 1));
  }
  std::cout << fmt::format("thickness {} of radius {}: {} unknowns, largest difference in pressure {:.3f} %\n",
                           thickness, radius, system.n_free(), 100 * largest);
  return largest;
}

// kappa/mu is 1e4: the closed form is incompressible, and at 1e3 the wall's own volume change costs 0.2 %. The thin
// walls have 384 cells; what is left of the thick ones is the quadratic displacement through the wall.
// With three integration points through the wall the sphere of 12 mm is 38 % too stiff (at kappa/mu 1e3).
TEST(InflatedSphere, NeoHookeanMatchesTheClosedForm)
{
  EXPECT_LE(largest_difference(3, 2, {0.1, 0, 0}), 2e-3);
  EXPECT_LE(largest_difference(2, 12, {0.1, 0, 0}), 2e-3);
}

TEST(InflatedSphere, YeohMatchesTheClosedForm)
{
  EXPECT_LE(largest_difference(3, 2, {0.1, 0.05, 0.02}), 1e-3);
  EXPECT_LE(largest_difference(2, 12, {0.1, 0.05, 0.02}), 2e-3);
}

// The thickest wall of the pelvis: the vagina's, 3 mm on a tube of 5.5 mm.
TEST(InflatedSphere, AWallOfHalfTheRadiusMatchesTheClosedForm)
{
  EXPECT_LE(largest_difference(2, 21.6, {0.1, 0.05, 0.02}), 1e-2);
}
} // namespace
} // namespace pelvireg::reference_fe
