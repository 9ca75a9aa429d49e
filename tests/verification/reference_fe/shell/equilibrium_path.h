// Load-displacement curves of a single shell, followed along their path, and how far a table's points lie from them.
#pragma once

#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// One equilibrium: the load factor, then the observed displacements.
using PathPoint = std::vector<double>;

struct PathOptions
{
  double first_load = 0.005; ///< load factor of the first, load-controlled step
  double largest_load = 1;   ///< the path ends at or beyond it
  double largest_step =
      0.05; ///< growth of any observed displacement in a step, as a fraction of its largest tabulated one
  int max_iterations = 15; ///< of Newton's method, a step: thin shells in bending take more
  int max_points = 400;
};

/// Arc-length steps (PathControl over the mid-surface) from rest. `forces`: (unknown, force at load factor 1).
/// `scale`: the largest tabulated value of every observed displacement. Throws std::runtime_error when a step fails at
/// a hundredth of its length, or max_points do not reach largest_load.
std::vector<PathPoint> follow_path(SingleShell &shell, const std::vector<std::pair<int, double>> &forces,
                                   const std::function<std::vector<double>(const Eigen::VectorXd &)> &observe,
                                   const std::vector<double> &scale, const PathOptions &options);

/// Largest distance of the table's points (load, displacement `column`) from the polyline of the path, load and
/// displacement each divided by their largest tabulated value.
double largest_distance(const std::vector<PathPoint> &path, const std::vector<std::vector<double>> &table, int column);
} // namespace pelvireg::reference_fe
