// Sze, Liu, Lo, Popular benchmark problems for geometric nonlinear analysis of shells, Finite Elements in Analysis and
// Design 40 (2004) 1551-1569: every tabulated load.
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
const std::string tables = SZE2004_TABLES;

/// Shortening and deflection of the inextensible elastica, E I theta'' = -P cos(theta), theta(0) = 0, theta'(L) = 0, by
/// shooting for theta'(0) with the Runge-Kutta method of order 4.
Eigen::Vector2d elastica(double load, double length, double bending_stiffness)
{
  const int n = 400;
  const double h = length / n;
  const auto rate = [&](const Eigen::Vector4d &y) // theta, theta', x, z
  { return Eigen::Vector4d(y[1], -load / bending_stiffness * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])); };
  const auto shoot = [&](double curvature)
  {
    Eigen::Vector4d y(0, curvature, 0, 0);
    for (int i = 0; i < n; ++i)
    {
      const Eigen::Vector4d k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  };
  double low = 0, high = load * length / bending_stiffness;
  for (int i = 0; i < 60; ++i)
    (shoot(0.5 * (low + high))[1] > 0 ? high : low) = 0.5 * (low + high);
  const Eigen::Vector4d tip = shoot(low);
  return {length - tip[2], tip[3]};
}

/// Largest differences of the computed columns from the table's, as fractions of each column's largest entry.
struct Comparison
{
  Eigen::Vector2d largest = Eigen::Vector2d::Zero(), scale = Eigen::Vector2d::Zero(), last = Eigen::Vector2d::Zero();
  Eigen::Vector2d from_closed_form = Eigen::Vector2d::Zero();
  int n_iterations = 0, n_failed = 0;
};

/// Load control through every row of the table; `observe` gives the two tabulated displacements. `closed_form` may be
/// empty.
Comparison follow_table(SingleShell &shell, DeadLoad &load, const std::string &table,
                        const std::function<Eigen::Vector2d(const Eigen::VectorXd &)> &observe,
                        const std::function<Eigen::Vector2d(double)> &closed_form, const NewtonOptions &options)
{
  Comparison comparison;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  for (const auto &row : read_table(tables + "/" + table))
  {
    load.set_factor(row[0]);
    const NewtonResult result = solve_newton(shell.system, solution, options);
    comparison.n_failed += !result.converged();
    comparison.n_iterations += static_cast<int>(result.iterations.size());
    const Eigen::Vector2d expected(row[1], row[2]);
    comparison.last = observe(solution);
    comparison.largest = comparison.largest.cwiseMax((comparison.last - expected).cwiseAbs());
    if (closed_form)
      comparison.from_closed_form =
          comparison.from_closed_form.cwiseMax((comparison.last - closed_form(row[0])).cwiseAbs());
    comparison.scale = comparison.scale.cwiseMax(expected.cwiseAbs());
  }
  comparison.largest.array() /= comparison.scale.array();
  comparison.from_closed_form.array() /= comparison.scale.array();
  std::cout << fmt::format("{}: {} unknowns, {} iterations, last {:.4f} {:.4f}, largest differences from the table "
                           "{:.3f} % {:.3f} %",
                           table, shell.system.n_free(), comparison.n_iterations, comparison.last[0],
                           comparison.last[1], 100 * comparison.largest[0], 100 * comparison.largest[1]);
  if (closed_form)
    std::cout << fmt::format(", from the closed form {:.3f} % {:.3f} %", 100 * comparison.from_closed_form[0],
                             100 * comparison.from_closed_form[1]);
  std::cout << "\n";
  return comparison;
}

/// Case 3.1: L 10, b 1, h 0.1, E 1.2e6, nu 0, end shear 4.
Comparison cantilever_under_end_shear(int n_cells)
{
  SingleShell shell(
      n_cells, 1, 2, 0.1, [](double s, double t) { return Eigen::Vector3d(10 * s, t, 0); },
      std::make_shared<SaintVenantKirchhoff>(1.2e6, 0.0), true);
  shell.fix(shell.nodes_where([](double s, double) { return s < 1e-9; }), {0, 1, 2, 3, 4, 5});
  std::vector<std::pair<int, double>> forces;
  for (const auto &[node, weight] : edge_weights(
           shell.body, shell.parameters, [](double s, double) { return s - 1; }, [](double, double t) { return t; }))
    forces.push_back({shell.unknown(node, 2), 4.0 * weight});
  const auto load = std::make_shared<DeadLoad>(forces);
  shell.system.add_term(load);
  const int tip = shell.nodes_where([](double s, double t) { return s > 1 - 1e-9 && std::abs(t - 0.5) < 1e-9; })[0];
  const auto observe = [&](const Eigen::VectorXd &x)
  { return Eigen::Vector2d(-x[shell.unknown(tip, 0)], x[shell.unknown(tip, 2)]); };
  NewtonOptions options;
  options.residual_tolerance = 1e-6;
  options.max_merit_growth = 1e12;
  options.max_iterations = 50;
  return follow_table(
      shell, *load, "cantilever_end_shear.csv", observe,
      [](double factor) { return elastica(4 * factor, 10, 1.2e6 * 1e-3 / 12); }, options);
}

/// Case 3.3: annulus of 6 to 10, h 0.03, slit along a radius; one side of the slit clamped, the other lifted by 0.8 per
/// length. A inner, B outer end of the lifted side.
Comparison slit_annular_plate(int n_around, int n_across)
{
  SingleShell shell(
      n_around, n_across, 2, 0.03,
      [](double s, double t)
      {
        const double angle = 2 * std::numbers::pi * s, r = 6 + 4 * t;
        return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0);
      },
      std::make_shared<SaintVenantKirchhoff>(21e6, 0.0), true);
  shell.fix(shell.nodes_where([](double s, double) { return s < 1e-9; }), {0, 1, 2, 3, 4, 5});
  std::vector<std::pair<int, double>> forces;
  for (const auto &[node, weight] : edge_weights(
           shell.body, shell.parameters, [](double s, double) { return s - 1; }, [](double, double t) { return t; }))
    forces.push_back({shell.unknown(node, 2), 0.8 * 4 * weight});
  const auto load = std::make_shared<DeadLoad>(forces);
  shell.system.add_term(load);
  const int a = shell.nodes_where([](double s, double t) { return s > 1 - 1e-9 && t < 1e-9; })[0];
  const int b = shell.nodes_where([](double s, double t) { return s > 1 - 1e-9 && t > 1 - 1e-9; })[0];
  const auto observe = [&](const Eigen::VectorXd &x)
  { return Eigen::Vector2d(x[shell.unknown(a, 2)], x[shell.unknown(b, 2)]); };
  NewtonOptions options;
  options.residual_tolerance = 1e-6;
  options.max_merit_growth = 1e12;
  options.max_iterations = 60;
  return follow_table(shell, *load, "slit_annular_plate.csv", observe, {}, options);
}

// Abaqus S4R's table against a converged p = 2 solution: 0.4 %.
TEST(Sze2004, SlitAnnularPlateUnderLineForceMatchesEveryTabulatedLoad)
{
  const Comparison comparison = slit_annular_plate(36, 4);
  EXPECT_EQ(comparison.n_failed, 0);
  EXPECT_LE(comparison.largest.maxCoeff(), 1e-2);
}

// The table itself is 0.10 % (3.286 against 3.2894) from the inextensible elastica at full load, and ours is on the
// elastica's other side by its axial and shear strains: the closed form is the sharper judge.
TEST(Sze2004, CantileverUnderEndShearMatchesTheElasticaAndEveryTabulatedLoad)
{
  for (const int n_cells : {8, 16})
  {
    const Comparison comparison = cantilever_under_end_shear(n_cells);
    EXPECT_EQ(comparison.n_failed, 0);
    EXPECT_LE(comparison.from_closed_form.maxCoeff(), 0.5e-3) << n_cells << " cells";
    EXPECT_LE(comparison.largest[0], 1.3e-3) << n_cells << " cells";
    EXPECT_LE(comparison.largest[1], 1e-3) << n_cells << " cells";
  }
}
} // namespace
} // namespace pelvireg::reference_fe
