// Linear shell problems at loads so small that one Newton step solves them: MacNeal and Harder, A proposed standard set
// of problems to test finite element accuracy, Finite Elements in Analysis and Design 1 (1985) 3-20; the pinched
// cylinder: Belytschko et al., Comput. Methods Appl. Mech. Eng. 51 (1985) 221-258.
#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

namespace pelvireg::reference_fe
{
namespace
{
using Forces = std::vector<std::pair<int, double>>;

const auto begins = [](double s, double) { return s < 1e-9; };
const auto ends = [](double s, double) { return s > 1 - 1e-9; };
const auto starts_across = [](double, double t) { return t < 1e-9; };
const auto ends_across = [](double, double t) { return t > 1 - 1e-9; };

int corner(const SingleShell &shell, double s, double t)
{
  return shell.nodes_where([&](double a, double b) { return std::abs(a - s) + std::abs(b - t) < 1e-9; }).at(0);
}

/// Neither the mid-surface nor the director leaves the plane normal to coordinate c.
void mirror(SingleShell &shell, const std::vector<int> &nodes, int c)
{
  shell.fix(nodes, {c, 3 + c});
}

/// Displacements of the linear problem, per unit of the forces.
Eigen::VectorXd solve_linear(SingleShell &shell, const Forces &forces)
{
  shell.system.add_term(std::make_shared<DeadLoad>(forces));
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  shell.system.assemble(rest, true);
  EXPECT_TRUE(shell.system.factorise());
  return shell.system.solve(-shell.system.residual());
}

void expect_published(const std::string &name, double value, double published, double tolerance)
{
  std::cout << fmt::format("{}: {:.5g}, published {:.5g}, difference {:.3f} %\n", name, value, published,
                           100 * (value / published - 1));
  EXPECT_NEAR(value / published, 1, tolerance) << name;
}

SurfaceMap cylinder(double radius, double angle, double length)
{
  return [=](double s, double t)
  { return Eigen::Vector3d(radius * std::sin(angle * s), length * t, radius * std::cos(angle * s)); };
}

/// Share of a uniform surface load that a node of n quadratic cells over [0, 1] carries.
double line_weight(double s, int n)
{
  const int index = static_cast<int>(std::lround(2 * n * s));
  if (index % 2 == 1)
    return 4. / 6 / n;
  return (index == 0 || index == 2 * n ? 1. : 2.) / 6 / n;
}

// Weight 90 per area, vertical displacement of the free edge's middle; MacNeal and Harder give 0.3024.
TEST(LinearShells, ScordelisLoRoofSagsAsPublished)
{
  const int n = 8;
  const double angle = 40 * std::numbers::pi / 180;
  SingleShell shell(n, n, 2, 0.25, cylinder(25, angle, 25), std::make_shared<SaintVenantKirchhoff>(4.32e8, 0.0), false);
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(starts_across), 1);
  shell.fix(shell.nodes_where(ends_across), {0, 2});
  Forces forces;
  for (int node = 0; node < shell.body.n_nodes(); ++node)
    forces.push_back({shell.unknown(node, 2), -90 * 25 * angle * 25 * line_weight(shell.parameters(0, node), n) *
                                                  line_weight(shell.parameters(1, node), n)});
  const Eigen::VectorXd x = solve_linear(shell, forces);
  expect_published("Scordelis-Lo roof", -x[shell.unknown(corner(shell, 1, 0), 2)], 0.3024, 1e-2);
}

// Open at 18 degrees, forces of 2 in and out on the equator; MacNeal and Harder give 0.0940.
TEST(LinearShells, PinchedHemisphereMovesAsPublished)
{
  const auto sphere = [](double s, double t)
  {
    const double azimuth = std::numbers::pi / 2 * s, polar = std::numbers::pi / 180 * (18 + 72 * t);
    return Eigen::Vector3d(10 * std::cos(azimuth) * std::sin(polar), 10 * std::sin(azimuth) * std::sin(polar),
                           10 * std::cos(polar));
  };
  SingleShell shell(12, 12, 2, 0.04, sphere, std::make_shared<SaintVenantKirchhoff>(6.825e7, 0.3), false);
  mirror(shell, shell.nodes_where(begins), 1);
  mirror(shell, shell.nodes_where(ends), 0);
  const int a = corner(shell, 0, 1), b = corner(shell, 1, 1);
  shell.fix({corner(shell, 0, 0)}, {2});
  const Eigen::VectorXd x = solve_linear(shell, {{shell.unknown(a, 0), 1.}, {shell.unknown(b, 1), -1.}});
  expect_published("hemisphere with a hole", x[shell.unknown(a, 0)], 0.0940, 1e-2);
}

// Two opposite forces of 1 in the middle of a cylinder between diaphragms: 1.8248e-5.
TEST(LinearShells, PinchedCylinderWithDiaphragmsGivesWayAsPublished)
{
  SingleShell shell(16, 16, 2, 3, cylinder(300, std::numbers::pi / 2, 300),
                    std::make_shared<SaintVenantKirchhoff>(3e6, 0.3), false);
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  mirror(shell, shell.nodes_where(starts_across), 1);
  shell.fix(shell.nodes_where(ends_across), {0, 2});
  const int a = shell.unknown(corner(shell, 0, 0), 2);
  expect_published("pinched cylinder", -solve_linear(shell, {{a, -0.25}})[a], 1.8248e-5, 2e-2);
}

using Vertex = Eigen::Vector2d (*)(double, double);

Eigen::Vector2d sheared(double a, double b)
{
  return {a + 0.3 * b, b + 0.1 * a};
}

Eigen::Vector2d irregular(double a, double b)
{
  return {a + 0.08 * std::sin(9 * a) * std::sin(7 * b), b + 0.07 * std::sin(8 * a) * std::sin(9 * b)};
}

/// A plate of 3 x 3 cells with straight edges between the vertices.
SurfaceMap plate(Vertex vertex)
{
  return [=](double s, double t)
  {
    const double h = 1. / 3;
    const double i = std::min(std::floor(s / h + 1e-9), 2.) * h, j = std::min(std::floor(t / h + 1e-9), 2.) * h;
    const double u = (s - i) / h, v = (t - j) / h;
    const Eigen::Vector2d p = (1 - u) * (1 - v) * vertex(i, j) + u * (1 - v) * vertex(i + h, j) +
                              u * v * vertex(i + h, j + h) + (1 - u) * v * vertex(i, j + h);
    return Eigen::Vector3d(p[0], p[1], 0);
  };
}

using Field = std::function<Eigen::Vector3d(const Eigen::Vector3d &)>;

/// Largest distance of the free mid-surface displacements from `field` when the border follows it, in units of the
/// field's largest value; `director` is the change of the director that goes with it.
double patch_difference(Vertex vertex, const Field &field, const Field &director)
{
  SingleShell shell(3, 3, 2, 0.02, plate(vertex), std::make_shared<SaintVenantKirchhoff>(1e6, 0.25), false);
  const auto border = [](double s, double t) { return std::min({s, t, 1 - s, 1 - t}) < 1e-9; };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  for (const int node : shell.nodes_where(border))
  {
    const Eigen::Vector3d at = shell.body.midsurface.col(node);
    for (int k = 0; k < 3; ++k)
    {
      x[shell.unknown(node, k)] = field(at)[k];
      x[shell.unknown(node, 3 + k)] = director(at)[k]; // its length along z stays free
    }
    shell.fix({node}, {0, 1, 2, 3, 4});
  }
  shell.system.assemble(x, true);
  EXPECT_TRUE(shell.system.factorise());
  x += shell.system.solve(-shell.system.residual());
  double largest = 0, scale = 0;
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    const Eigen::Vector3d expected = field(shell.body.midsurface.col(node));
    largest = std::max(largest, (x.segment<3>(shell.unknown(node, 0)) - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  return largest / scale;
}

// Strains of 1e-8: what is nonlinear in them is sixteen times this, relatively.
constexpr double e = 1e-8;

double membrane_difference(Vertex vertex)
{
  return patch_difference(
      vertex, [](const Eigen::Vector3d &p) { return Eigen::Vector3d(e * (p[0] + p[1] / 2), e * (p[1] + p[0] / 2), 0); },
      [](const Eigen::Vector3d &) { return Eigen::Vector3d(0, 0, 0); });
}

double bending_difference(Vertex vertex)
{
  return patch_difference(
      vertex,
      [](const Eigen::Vector3d &p) { return Eigen::Vector3d(0, 0, e * (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]) / 2); },
      [](const Eigen::Vector3d &p) { return Eigen::Vector3d(-e * (p[0] + p[1] / 2), -e * (p[1] + p[0] / 2), 0); });
}

// Assumed strains hold a constant strain exactly; the forces of a constant stress are those of the displacements only
// where the cells' base vectors are constant. Irregular cells are therefore off by a little.
TEST(LinearShells, PatchesOfParallelogramsAreExactAndOfIrregularCellsNearly)
{
  const double membrane[] = {membrane_difference(sheared), membrane_difference(irregular)};
  const double bending[] = {bending_difference(sheared), bending_difference(irregular)};
  std::cout << fmt::format("membrane patch: parallelograms {:.1e}, irregular {:.1e}\n", membrane[0], membrane[1])
            << fmt::format("bending patch: parallelograms {:.1e}, irregular {:.1e}\n", bending[0], bending[1]);
  EXPECT_LE(membrane[0], 1e-6);
  EXPECT_LE(membrane[1], 3e-4);
  EXPECT_LE(bending[0], 1e-6);
  EXPECT_LE(bending[1], 3e-4);
}
} // namespace
} // namespace pelvireg::reference_fe
