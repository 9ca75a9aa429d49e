// What the shell benchmarks share: a structured patch, edge loads, supports, load steps.
#pragma once

#include "reference_fe/elements/shell_term.h"
#include "reference_fe/newton_solver.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
using SurfaceMap = std::function<Eigen::Vector3d(double, double)>;

/// n1 x n2 cells of order p over [0, 1]^2, moved by `map(s, t)`. `parameters` (2 x n_nodes) holds (s, t) of each node.
ShellBody structured_shell(int n1, int n2, int order, double thickness, const SurfaceMap &map,
                           Eigen::Matrix2Xd &parameters);

/// Flat cells with straight edges between `vertices` (a column each); a column of `cells` has the corners in the order
/// of FE_Q(1): (0, 0), (1, 0), (0, 1), (1, 1).
ShellBody flat_shell(const Eigen::Matrix2Xd &vertices, const Eigen::Matrix4Xi &cells, int order, double thickness);

/// Quadratic cells over a sphere about the origin, 6 * 4^refinements of them, directors outward.
ShellBody sphere_shell(int refinements, double radius, double thickness);

/// Weights of the nodes with |distance(s, t)| < 1e-9 for a force of 1 spread evenly over that edge. `along(s, t)`
/// orders them; its cells are of equal length.
std::vector<std::pair<int, double>> edge_weights(const ShellBody &body, const Eigen::Matrix2Xd &parameters,
                                                 const std::function<double(double, double)> &distance,
                                                 const std::function<double(double, double)> &along);

/// A shell alone in a system.
struct SingleShell
{
  Eigen::Matrix2Xd parameters; ///< filled while `body` is made: must stay before it
  ShellBody body;
  EquilibriumSystem system;
  int first = 0;

  SingleShell(int n1, int n2, int order, double thickness, const SurfaceMap &map,
              std::shared_ptr<const HyperelasticLaw> law, bool mixed_integration_points);
  /// `parameters_of_nodes`: what nodes_where() asks about, a column a node.
  SingleShell(ShellBody shell, Eigen::Matrix2Xd parameters_of_nodes, std::shared_ptr<const HyperelasticLaw> law,
              bool mixed_integration_points);

  int unknown(int node, int component) const { return first + n_shell_unknowns * node + component; }
  /// Nodes for which `selects(s, t)` holds.
  std::vector<int> nodes_where(const std::function<bool(double, double)> &selects) const;
  void fix(const std::vector<int> &nodes, const std::vector<int> &components);
};

/// Edges of the unit square.
inline bool begins(double s, double)
{
  return s < 1e-9;
}
inline bool ends(double s, double)
{
  return s > 1 - 1e-9;
}
inline bool starts_across(double, double t)
{
  return t < 1e-9;
}
inline bool ends_across(double, double t)
{
  return t > 1 - 1e-9;
}

/// The node at (s, t); throws std::out_of_range when there is none.
int corner(const SingleShell &shell, double s, double t);
/// Mirror plane normal to coordinate c: neither the mid-surface nor the director of these nodes leaves it.
void mirror(SingleShell &shell, const std::vector<int> &nodes, int c);
/// A cylinder about y: angle s of the opening from the top (z), t along the axis.
SurfaceMap cylinder(double radius, double angle, double length);

/// n1 x n2 cells with straight edges between their vertices, vertex(i, j) for i = 0 … n1, j = 0 … n2.
SurfaceMap straight_cells(int n1, int n2, const std::function<Eigen::Vector3d(int, int)> &vertex);
/// A force spread evenly over the edge s = 1, as (unknown, force).
std::vector<std::pair<int, double>> end_force(const SingleShell &shell, int component, double force);

/// Displacements of the linear problem under these forces; throws std::runtime_error when it is singular.
Eigen::VectorXd solve_linear(SingleShell &shell, const std::vector<std::pair<int, double>> &forces);

/// A table of the source: comment lines begin with #, then one header line.
std::vector<std::vector<double>> read_table(const std::string &file);
} // namespace pelvireg::reference_fe
