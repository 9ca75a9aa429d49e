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

/// A single force; the residual may be 1e-8 of it.
void point_load(LoadedShell &loaded, int unknown, double force)
{
  load_by(loaded, {{unknown, force}});
  loaded.residual_tolerance = 1e-8 * std::abs(force);
}

/// Cases 3.1 and 3.2: L 10 or 12, b 1, E I 100 (h 0.1 and E 1.2e6 in the source), clamped at one end.
LoadedShell cantilever(const CellCounts &cells, double length, double thickness)
{
  LoadedShell loaded = loaded_shell(
      cells, thickness, [=](double s, double t) { return Eigen::Vector3d(length * s, t, 0); },
      1200 / std::pow(thickness, 3), 0);
  loaded.shell->fix(loaded.shell->nodes_where(begins), {0, 1, 2, 3, 4, 5});
  const int tip = corner(*loaded.shell, 1, 0);
  loaded.observed = {{loaded.shell->unknown(tip, 0), -1.}, {loaded.shell->unknown(tip, 2), 1.}};
  return loaded;
}

LoadedShell end_shear_of(const CellCounts &cells, double thickness)
{
  LoadedShell loaded = cantilever(cells, 10, thickness);
  load_by(loaded, end_force(*loaded.shell, 2, 4));
  return loaded;
}

LoadedShell end_moment_of(const CellCounts &cells, double thickness)
{
  LoadedShell loaded = cantilever(cells, 12, thickness);
  const SingleShell &shell = *loaded.shell;
  std::vector<DirectorCouple::LoadedNode> nodes;
  for (const auto &[first_unknown, moment] : end_force(shell, 0, 50 * pi / 3))
    nodes.push_back({first_unknown, Eigen::Vector3d::UnitZ(), moment});
  loaded.load = [nodes](int factor)
  { return std::make_shared<DirectorCouple>(nodes, -Eigen::Vector3d::UnitY(), factor); };
  return loaded;
}

template <LoadedShell (*cantilever_of)(const CellCounts &, double), int thickness_per_thousand>
LoadedShell of_thickness(const CellCounts &cells)
{
  return cantilever_of(cells, 1e-3 * thickness_per_thousand);
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
  loaded.observed = {{shell.unknown(corner(shell, 1, 0), 2), 1.}, {shell.unknown(corner(shell, 1, 1), 2), 1.}};
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
  loaded.observed = {{a, 1.}, {b, -1.}};
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
  point_load(loaded, a, 10000);
  loaded.observed = {
      {a, 1.}, {shell.unknown(corner(shell, 1, 0), 0), -1.}, {shell.unknown(corner(shell, 1, 1), 0), -1.}};
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
  point_load(loaded, a, -3000);
  loaded.observed = {{a, -1.}, {shell.unknown(corner(shell, 1, 0), 0), 1.}};
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
  point_load(loaded, a, -1000);
  loaded.observed = {{a, -100.}};
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
  point_load(loaded, c, -3000. / 4);
  loaded.observed = {{c, -1.}};
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
/// Row 12 is where the side's snap ends: a displacement there changes more than twice as fast as the load.
const PathOptions pulled_out = {.at_displacement = [](int row) { return row == 12; }};
/// Rows 4 and 5, where the dents at the load and at the side meet: five and seven times as fast.
const PathOptions dents = {.largest_step = 0.05,
                           .max_iterations = 20,
                           .max_points = 2000,
                           .at_displacement = [](int row) { return row == 4 || row == 5; }};
/// Rows 8 to 12, where the end folds flat: two to three times as fast.
const PathOptions flattened = {.at_displacement = [](int row) { return row >= 8 && row <= 12; }};
const PathOptions snap = {.first_load = 0.02, .largest_step = 0.02, .at_displacement = [](int) { return true; }};
/// The thin roof: rows 11 to 19, where the displacement turns back, are compared by their displacement.
const PathOptions snap_back = {
    .first_load = 0.02, .largest_step = 0.02, .at_displacement = [](int row) { return row < 11 || row > 19; }};
} // namespace

const std::vector<SzeCase> &sze_cases()
{
  static const std::vector<SzeCase> cases = {
      {"end shear", "cantilever_end_shear.csv", of_thickness<end_shear_of, 100>, by_load, 1e-3, 1e-3},
      {"end shear, thinner", "cantilever_end_shear.csv", of_thickness<end_shear_of, 25>, by_load, 1e-3, 1e-3},
      {"end moment", "cantilever_end_moment.csv", of_thickness<end_moment_of, 100>, by_load, 1e-3, 1e-3},
      {"end moment, thinner", "cantilever_end_moment.csv", of_thickness<end_moment_of, 25>, by_load, 1e-3, 1e-3},
      {"slit annulus", "slit_annular_plate.csv", slit_annulus, by_load},
      {"hemisphere", "hemisphere_18.csv", hemisphere, by_load, 1e-2, 1e-2},
      {"pull-out", "open_cylinder_pullout.csv", pull_out, pulled_out, 5e-3, 1e-2, 0.5},
      {"pinched cylinder", "pinched_cylinder_diaphragms.csv", pinched_cylinder, dents, 2e-2, 2e-2},
      {"semi-cylinder", "semi_cylinder.csv", semi_cylinder, flattened},
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

CurveComparison SzeCase::compare(const CellCounts &cells, const PathLog &log, int n_rows) const
{
  LoadedShell loaded = make(cells);
  PathOptions with_log = options;
  with_log.log = log;
  with_log.n_rows = n_rows;
  return follow_table(loaded, table(), with_log);
}
} // namespace pelvireg::reference_fe
