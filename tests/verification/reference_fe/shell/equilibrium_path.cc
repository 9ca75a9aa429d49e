#include "tests/verification/reference_fe/shell/equilibrium_path.h"

#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/constraints/path_control.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
std::vector<SurfaceNode> midsurface_nodes(const SingleShell &shell)
{
  std::vector<SurfaceNode> nodes(shell.body.n_nodes());
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    nodes[node].first_unknown = shell.unknown(node, 0);
    nodes[node].rest = shell.body.midsurface.col(node);
  }
  return nodes;
}

/// Largest growth of an observed displacement, in units of its scale.
double step_length(const PathPoint &from, const PathPoint &to, const std::vector<double> &scale)
{
  double largest = 0;
  for (std::size_t k = 0; k < scale.size(); ++k)
    largest = std::max(largest, std::abs(to[k + 1] - from[k + 1]) / scale[k]);
  return largest;
}

double distance_to_segment(const Eigen::Vector2d &p, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
{
  const double length = (b - a).squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0., 1.) : 0;
  return (p - a - t * (b - a)).norm();
}
} // namespace

std::vector<PathPoint> follow_path(SingleShell &shell, const std::vector<std::pair<int, double>> &forces,
                                   const std::function<std::vector<double>(const Eigen::VectorXd &)> &observe,
                                   const std::vector<double> &scale, const PathOptions &options)
{
  EquilibriumSystem &system = shell.system;
  const int load = system.add_unknowns(1, {"load factor"});
  system.add_term(std::make_shared<DeadLoad>(forces, load));
  const auto control = std::make_shared<PathControl>(midsurface_nodes(shell), load);
  system.add_term(control);
  NewtonOptions newton;
  double largest_force = 0;
  for (const auto &[unknown, force] : forces)
    largest_force = std::max(largest_force, std::abs(force));
  newton.residual_tolerance = 1e-8 * largest_force;
  newton.max_iterations = options.max_iterations;
  newton.max_merit_growth = 1e12;

  Eigen::VectorXd previous = Eigen::VectorXd::Zero(system.n_unknowns()), current = previous;
  const auto point = [&](const Eigen::VectorXd &x)
  {
    PathPoint p = observe(x);
    p.insert(p.begin(), x[load]);
    return p;
  };
  std::vector<PathPoint> path = {point(current)};
  current[load] = options.first_load;
  system.fix(load);
  if (!solve_newton(system, current, newton).converged())
    throw std::runtime_error("the first step of the path failed");
  system.release(load);
  path.push_back(point(current));

  double ratio = 1;
  while (path.back()[0] < options.largest_load)
  {
    if (static_cast<int>(path.size()) > options.max_points || ratio < 0.01)
      throw std::runtime_error("the path ends at the load factor " + std::to_string(path.back()[0]));
    Eigen::VectorXd trial = current + ratio * (current - previous);
    control->prescribe(current, trial);
    const NewtonResult result = solve_newton(system, trial, newton);
    if (!result.converged() || step_length(path.back(), point(trial), scale) > 2 * options.largest_step)
    {
      ratio *= 0.5;
      continue;
    }
    previous = std::exchange(current, trial);
    path.push_back(point(current));
    const double length = step_length(path[path.size() - 2], path.back(), scale);
    const double wanted = 2 * static_cast<int>(result.iterations.size()) > options.max_iterations ? 0.7 : 1.5;
    ratio = std::min(wanted, options.largest_step / std::max(length, 1e-12));
  }
  return path;
}

double largest_distance(const std::vector<PathPoint> &path, const std::vector<std::vector<double>> &table, int column)
{
  double load_scale = 0, scale = 0;
  for (const std::vector<double> &row : table)
  {
    load_scale = std::max(load_scale, std::abs(row[0]));
    scale = std::max(scale, std::abs(row[column]));
  }
  const auto scaled = [&](const std::vector<double> &row)
  { return Eigen::Vector2d(row[0] / load_scale, row[column] / scale); };
  double largest = 0;
  for (const std::vector<double> &row : table)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      nearest = std::min(nearest, distance_to_segment(scaled(row), scaled(path[k]), scaled(path[k + 1])));
    largest = std::max(largest, nearest);
  }
  return largest;
}
} // namespace pelvireg::reference_fe
