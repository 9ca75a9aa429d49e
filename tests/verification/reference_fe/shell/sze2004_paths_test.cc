// Sze, Liu, Lo, Popular benchmark problems for geometric nonlinear analysis of shells, Finite Elements in Analysis and
// Design 40 (2004) 1551-1569: load-displacement curves with limit points and snaps, followed by arc length. A table's
// points may lie off our curve by a fraction of its largest load and displacement; the tables are of Abaqus S4R, which
// is itself 0.3 to 0.6 % from converged solutions.
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "tests/verification/reference_fe/shell/equilibrium_path.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace pelvireg::reference_fe
{
namespace
{
using Forces = std::vector<std::pair<int, double>>;
using Observed = std::function<std::vector<double>(const Eigen::VectorXd &)>;

const auto begins = [](double s, double) { return s < 1e-9; };
const auto ends = [](double s, double) { return s > 1 - 1e-9; };
const auto starts_across = [](double, double t) { return t < 1e-9; };
const auto ends_across = [](double, double t) { return t > 1 - 1e-9; };

int corner(const SingleShell &shell, double s, double t)
{
  return shell.nodes_where([&](double a, double b) { return std::abs(a - s) + std::abs(b - t) < 1e-9; }).at(0);
}

/// Mirror plane normal to coordinate c: neither the mid-surface nor the director leaves it.
void mirror(SingleShell &shell, const std::vector<int> &nodes, int c)
{
  shell.fix(nodes, {c, 3 + c});
}

/// Largest distances of a table's columns from the path, printed and returned.
std::vector<double> differences(const std::string &table_name, SingleShell &shell, const Forces &forces,
                                const Observed &observe, PathOptions options = {})
{
  const auto table = read_table(std::string(SZE2004_TABLES) + "/" + table_name);
  std::vector<double> scale(table[0].size() - 1, 0);
  for (const auto &row : table)
    for (std::size_t k = 0; k < scale.size(); ++k)
      scale[k] = std::max(scale[k], std::abs(row[k + 1]));
  options.largest_load = table.back()[0];
  const auto path = follow_path(shell, forces, observe, scale, options);
  std::vector<double> differences;
  std::cout << fmt::format("{}: {} unknowns, {} points", table_name, shell.system.n_free(), path.size());
  for (std::size_t k = 0; k < scale.size(); ++k)
  {
    differences.push_back(largest_distance(path, table, static_cast<int>(k) + 1));
    std::cout << fmt::format(", column {}: {:.3f} %", k + 1, 100 * differences.back());
  }
  std::cout << "\n";
  return differences;
}

/// A cylinder about y: angle s of the opening from the top (z), t along the axis.
SurfaceMap cylinder(double radius, double angle, double length)
{
  return [=](double s, double t)
  { return Eigen::Vector3d(radius * std::sin(angle * s), length * t, radius * std::cos(angle * s)); };
}

// Case 3.5: an eighth of an open cylinder, pulled outward at A (top, middle); B at the side, C at the side's free end.
TEST(Sze2004, PulledOpenCylinderFollowsTheTable)
{
  SingleShell shell(12, 8, 2, 0.094, cylinder(4.953, std::numbers::pi / 2, 10.35 / 2),
                    std::make_shared<SaintVenantKirchhoff>(10.5e6, 0.3125), true);
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  mirror(shell, shell.nodes_where(starts_across), 1);
  const int a = shell.unknown(corner(shell, 0, 0), 2), b = shell.unknown(corner(shell, 1, 0), 0),
            c = shell.unknown(corner(shell, 1, 1), 0);
  const auto found = differences("open_cylinder_pullout.csv", shell, {{a, 10000.}},
                                 [=](const Eigen::VectorXd &x) {
                                   return std::vector<double>{x[a], -x[b], -x[c]};
                                 });
  for (const double difference : found)
    EXPECT_LE(difference, 1e-2);
}

// Case 3.7: half of a cylinder, clamped at one end, pinched at the free end's top; its straight edges slide in a plane.
TEST(Sze2004, PinchedSemiCylinderFollowsTheTable)
{
  SingleShell shell(12, 12, 2, 0.03, cylinder(1.016, std::numbers::pi / 2, 3.048),
                    std::make_shared<SaintVenantKirchhoff>(2.0685e7, 0.3), true);
  shell.fix(shell.nodes_where(starts_across), {0, 1, 2, 3, 4, 5});
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  const int a = shell.unknown(corner(shell, 0, 1), 2);
  const auto found = differences("semi_cylinder.csv", shell, {{a, -1000.}},
                                 [=](const Eigen::VectorXd &x) { return std::vector<double>{-100 * x[a]}; });
  EXPECT_LE(found[0], 1e-2);
}

/// Case 3.8: a quarter of a shallow cylindrical roof, hinged along its straight edges, pushed down in the middle.
double hinged_roof(double thickness, const std::string &table)
{
  SingleShell shell(6, 6, 2, thickness, cylinder(2540, 0.1, 254), std::make_shared<SaintVenantKirchhoff>(3102.75, 0.3),
                    true);
  shell.fix(shell.nodes_where(ends), {0, 1, 2});
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(starts_across), 1);
  const int c = shell.unknown(corner(shell, 0, 0), 2);
  return differences(table, shell, {{c, -3000. / 4}},
                     [=](const Eigen::VectorXd &x) { return std::vector<double>{-x[c]}; },
                     {.first_load = 0.02, .largest_step = 0.015})[0];
}

TEST(Sze2004, HingedRoofSnapsAlongTheTable)
{
  EXPECT_LE(hinged_roof(12.7, "hinged_roof_12_7.csv"), 1e-2);
}

// Load and displacement both turn back.
TEST(Sze2004, ThinHingedRoofSnapsBackAlongTheTable)
{
  EXPECT_LE(hinged_roof(6.35, "hinged_roof_6_35.csv"), 1e-2);
}
} // namespace
} // namespace pelvireg::reference_fe
