// Linear shell problems at loads so small that one Newton step solves them: MacNeal and Harder, A proposed standard set
// of problems to test finite element accuracy, Finite Elements in Analysis and Design 1 (1985) 3-20; the pinched
// cylinder: Belytschko et al., Comput. Methods Appl. Mech. Eng. 51 (1985) 221-258.
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

void expect_published(const std::string &name, double value, double published, double tolerance)
{
  std::cout << fmt::format("{}: {:.5g}, published {:.5g}, difference {:.3f} %\n", name, value, published,
                           100 * (value / published - 1));
  EXPECT_NEAR(value / published, 1, tolerance) << name;
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

/// Displacement under unit forces of the hemisphere open at 18 degrees, radius 10, forces of 2 in and out on the
/// equator.
double pinched_hemisphere(int n, int order, double thickness)
{
  const auto sphere = [](double s, double t)
  {
    const double azimuth = std::numbers::pi / 2 * s, polar = std::numbers::pi / 180 * (18 + 72 * t);
    return Eigen::Vector3d(10 * std::cos(azimuth) * std::sin(polar), 10 * std::sin(azimuth) * std::sin(polar),
                           10 * std::cos(polar));
  };
  SingleShell shell(n, n, order, thickness, sphere, std::make_shared<SaintVenantKirchhoff>(6.825e7, 0.3), false);
  mirror(shell, shell.nodes_where(begins), 1);
  mirror(shell, shell.nodes_where(ends), 0);
  const int a = corner(shell, 0, 1), b = corner(shell, 1, 1);
  shell.fix({corner(shell, 0, 0)}, {2});
  return solve_linear(shell, {{shell.unknown(a, 0), 1.}, {shell.unknown(b, 1), -1.}})[shell.unknown(a, 0)];
}

// MacNeal and Harder give 0.0940.
TEST(LinearShells, PinchedHemisphereMovesAsPublished)
{
  expect_published("hemisphere with a hole", pinched_hemisphere(12, 2, 0.04), 0.0940, 1e-2);
}

// Bending without stretching: displacement times (t/R)^3 tends to a constant. A cell that locks loses that with t.
TEST(LinearShells, PinchedHemisphereDoesNotLockFromRadiusOverThicknessTenToThousand)
{
  for (const double ratio : {10., 30., 100., 300., 1000.})
  {
    const double scale = 1e6 / std::pow(ratio, 3);
    const double stated = pinched_hemisphere(16, 2, 10 / ratio) * scale,
                 finer = pinched_hemisphere(12, 3, 10 / ratio) * scale;
    std::cout << fmt::format("R/t {}: displacement (t/R)^3 1e6 = {:.5g}, order 3: {:.5g}, ratio {:.4f}\n", ratio,
                             stated, finer, stated / finer);
    EXPECT_NEAR(stated / finer, 1, 1e-2) << ratio;
  }
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

} // namespace
} // namespace pelvireg::reference_fe
