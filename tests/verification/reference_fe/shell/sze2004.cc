#include "tests/verification/reference_fe/shell/sze2004.h"

#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "tests/verification/reference_fe/shell/director_couple.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pelvireg::reference_fe
{
namespace
{
using Forces = std::vector<std::pair<int, double>>;
constexpr double pi = std::numbers::pi;

LoadedShell loaded_shell(const CellCounts &cells, double thickness, const SurfaceMap &map, double youngs_modulus,
                         double poisson_ratio)
{
  LoadedShell loaded;
  loaded.shell =
      std::make_unique<SingleShell>(cells.n1, cells.n2, cells.order, thickness, map,
                                    std::make_shared<SaintVenantKirchhoff>(youngs_modulus, poisson_ratio), true);
  return loaded;
}

void load_by(LoadedShell &loaded, const Forces &forces)
{
  loaded.load = [forces](int factor) { return std::make_shared<DeadLoad>(forces, factor); };
}

/// One of the observed displacements: an unknown and the table's sign or scale.
void observe(LoadedShell &loaded, const Forces &unknowns)
{
  loaded.observe = [unknowns](const Eigen::VectorXd &x)
  {
    std::vector<double> values;
    for (const auto &[unknown, scale] : unknowns)
      values.push_back(scale * x[unknown]);
    return values;
  };
}

/// A single force at the first observed displacement.
void point_load(LoadedShell &loaded, int unknown, double force, double scale)
{
  load_by(loaded, {{unknown, force}});
  loaded.residual_tolerance = 1e-8 * std::abs(force);
  loaded.point_load = {unknown, force, scale};
}

/// Cases 3.1 and 3.2: L 10 or 12, b 1, h 0.1, clamped at one end. The middle of an edge is a node when the order is
/// even.
LoadedShell cantilever(const CellCounts &cells, double length)
{
  LoadedShell loaded = loaded_shell(
      cells, 0.1, [=](double s, double t) { return Eigen::Vector3d(length * s, t, 0); }, 1.2e6, 0);
  loaded.shell->fix(loaded.shell->nodes_where(begins), {0, 1, 2, 3, 4, 5});
  const int tip = corner(*loaded.shell, 1, 0);
  observe(loaded, {{loaded.shell->unknown(tip, 0), -1.}, {loaded.shell->unknown(tip, 2), 1.}});
  return loaded;
}

LoadedShell end_shear(const CellCounts &cells)
{
  LoadedShell loaded = cantilever(cells, 10);
  load_by(loaded, end_force(*loaded.shell, 2, 4));
  return loaded;
}

LoadedShell end_moment(const CellCounts &cells)
{
  LoadedShell loaded = cantilever(cells, 12);
  const SingleShell &shell = *loaded.shell;
  std::vector<DirectorCouple::LoadedNode> nodes;
  for (const auto &[first_unknown, moment] : end_force(shell, 0, 50 * pi / 3))
    nodes.push_back({first_unknown, Eigen::Vector3d::UnitZ(), moment});
  loaded.load = [nodes](int factor)
  { return std::make_shared<DirectorCouple>(nodes, -Eigen::Vector3d::UnitY(), factor); };
  return loaded;
}

/// Case 3.3: annulus of 6 to 10, slit along a radius; one side of the slit clamped, the other lifted by 0.8 per length.
/// A inner, B outer end of the lifted side.
LoadedShell slit_annulus(const CellCounts &cells)
{
  LoadedShell loaded = loaded_shell(
      cells, 0.03,
      [](double s, double t)
      {
        const double r = 6 + 4 * t;
        return Eigen::Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), 0);
      },
      21e6, 0);
  const SingleShell &shell = *loaded.shell;
  loaded.shell->fix(shell.nodes_where(begins), {0, 1, 2, 3, 4, 5});
  load_by(loaded, end_force(shell, 2, 0.8 * 4));
  observe(loaded, {{shell.unknown(corner(shell, 1, 0), 2), 1.}, {shell.unknown(corner(shell, 1, 1), 2), 1.}});
  return loaded;
}

/// Case 3.4: a quarter of a hemisphere open at 18 degrees; pulled outward at A, pushed inward at B, on its free
/// equator.
LoadedShell hemisphere(const CellCounts &cells)
{
  LoadedShell loaded = loaded_shell(
      cells, 0.04,
      [](double s, double t)
      {
        const double azimuth = pi / 2 * s, polar = pi / 180 * (18 + 72 * t);
        return Eigen::Vector3d(10 * std::cos(azimuth) * std::sin(polar), 10 * std::sin(azimuth) * std::sin(polar),
                               10 * std::cos(polar));
      },
      6.825e7, 0.3);
  SingleShell &shell = *loaded.shell;
  mirror(shell, shell.nodes_where(begins), 1);
  mirror(shell, shell.nodes_where(ends), 0);
  shell.fix({corner(shell, 0, 0)}, {2});
  const int a = shell.unknown(corner(shell, 0, 1), 0), b = shell.unknown(corner(shell, 1, 1), 1);
  load_by(loaded, {{a, 200.}, {b, -200.}});
  observe(loaded, {{a, 1.}, {b, -1.}});
  return loaded;
}

/// Case 3.5: an eighth of an open cylinder, pulled outward at A (top, middle); B at the side, C at the side's free end.
LoadedShell pull_out(const CellCounts &cells)
{
  LoadedShell loaded = loaded_shell(cells, 0.094, cylinder(4.953, pi / 2, 10.35 / 2), 10.5e6, 0.3125);
  SingleShell &shell = *loaded.shell;
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  mirror(shell, shell.nodes_where(starts_across), 1);
  const int a = shell.unknown(corner(shell, 0, 0), 2);
  point_load(loaded, a, 10000, 1);
  observe(loaded,
          {{a, 1.}, {shell.unknown(corner(shell, 1, 0), 0), -1.}, {shell.unknown(corner(shell, 1, 1), 0), -1.}});
  return loaded;
}

/// Case 3.6: an eighth of a cylinder between rigid diaphragms, pinched at A (top, middle); B at the side. The director
/// is free at the diaphragm.
LoadedShell pinched_cylinder(const CellCounts &cells)
{
  LoadedShell loaded = loaded_shell(cells, 1, cylinder(100, pi / 2, 100), 3e4, 0.3);
  SingleShell &shell = *loaded.shell;
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  mirror(shell, shell.nodes_where(starts_across), 1);
  shell.fix(shell.nodes_where(ends_across), {0, 2});
  const int a = shell.unknown(corner(shell, 0, 0), 2);
  point_load(loaded, a, -3000, -1);
  observe(loaded, {{a, -1.}, {shell.unknown(corner(shell, 1, 0), 0), 1.}});
  return loaded;
}

/// Case 3.7: half of a cylinder, clamped at one end, pinched at the free end's top; its straight edges slide in a
/// plane.
LoadedShell semi_cylinder(const CellCounts &cells)
{
  LoadedShell loaded = loaded_shell(cells, 0.03, cylinder(1.016, pi / 2, 3.048), 2.0685e7, 0.3);
  SingleShell &shell = *loaded.shell;
  shell.fix(shell.nodes_where(starts_across), {0, 1, 2, 3, 4, 5});
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  const int a = shell.unknown(corner(shell, 0, 1), 2);
  point_load(loaded, a, -1000, -100);
  observe(loaded, {{a, -100.}});
  return loaded;
}

/// Case 3.8: a quarter of a shallow cylindrical roof, hinged along its straight edges, pushed down in the middle.
LoadedShell hinged_roof(const CellCounts &cells, double thickness)
{
  LoadedShell loaded = loaded_shell(cells, thickness, cylinder(2540, 0.1, 254), 3102.75, 0.3);
  SingleShell &shell = *loaded.shell;
  shell.fix(shell.nodes_where(ends), {0, 1, 2});
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(starts_across), 1);
  const int c = shell.unknown(corner(shell, 0, 0), 2);
  point_load(loaded, c, -3000. / 4, -1);
  observe(loaded, {{c, -1.}});
  return loaded;
}

LoadedShell thick_roof(const CellCounts &cells)
{
  return hinged_roof(cells, 12.7);
}

LoadedShell thin_roof(const CellCounts &cells)
{
  return hinged_roof(cells, 6.35);
}

const PathOptions by_load = {.arc_length = false};
const PathOptions snap = {.first_load = 0.02, .largest_step = 0.02, .at_displacement = [](int) { return true; }};
/// The thin roof: rows 11 to 19, where the displacement turns back, and the steep end from row 33 on are compared by
/// their displacement.
const PathOptions snap_back = {.first_load = 0.02, .largest_step = 0.02, .at_displacement = [](int row) {
                                 return row < 11 || (row > 19 && row < 33);
                               }};
} // namespace

const std::vector<SzeCase> &sze_cases()
{
  static const std::vector<SzeCase> cases = {
      {"end shear", "cantilever_end_shear.csv", end_shear, by_load, 1e-3, 1e-3},
      {"end moment", "cantilever_end_moment.csv", end_moment, by_load, 1e-3, 1e-3},
      {"slit annulus", "slit_annular_plate.csv", slit_annulus, by_load},
      {"hemisphere", "hemisphere_18.csv", hemisphere, by_load, 1e-2, 1e-2},
      {"pull-out", "open_cylinder_pullout.csv", pull_out, {}, 5e-3, 1e-2, 0.5},
      {"pinched cylinder", "pinched_cylinder_diaphragms.csv", pinched_cylinder, {}, 2e-2, 2e-2},
      {"semi-cylinder", "semi_cylinder.csv", semi_cylinder, {}},
      {"roof 12.7", "hinged_roof_12_7.csv", thick_roof, snap},
      {"roof 6.35", "hinged_roof_6_35.csv", thin_roof, snap_back}};
  return cases;
}

const SzeCase &sze_case(const std::string &name)
{
  for (const SzeCase &sze : sze_cases())
    if (sze.name == name)
      return sze;
  throw std::out_of_range("no shell benchmark is called '" + name + "'");
}

std::vector<std::vector<double>> SzeCase::table() const
{
  return read_table(std::string(SZE2004_TABLES) + "/" + table_file);
}

CurveComparison SzeCase::compare(const CellCounts &cells) const
{
  LoadedShell loaded = make(cells);
  return follow_table(loaded, table(), options);
}

Eigen::Vector2d elastica(double load, double length, double bending_stiffness)
{
  const int n = 400; // steps of the Runge-Kutta method of order 4
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

Eigen::Vector2d rolled_up(double angle, double length)
{
  return {length * (1 - std::sin(angle) / angle), length * (1 - std::cos(angle)) / angle};
}
} // namespace pelvireg::reference_fe
