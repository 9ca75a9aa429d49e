// Load-displacement curves of a single shell, and how far the rows of a published table lie from them.
#pragma once

#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// A shell and a load scaled by one factor.
struct LoadedShell
{
  std::unique_ptr<SingleShell> shell;
  /// The load, scaled by the unknown whose index it is given.
  std::function<std::shared_ptr<Term>(int)> load;
  double residual_tolerance = 1e-6; ///< N; looser than 1e-8 of the load, soft thin shells stop a little off
  /// The tabulated displacements, with the table's signs.
  std::function<std::vector<double>(const Eigen::VectorXd &)> observe;
  /// For rows compared at their displacement: the one loaded unknown, its force at load factor 1, and the tabulated
  /// displacement over the unknown.
  struct PointLoad
  {
    int unknown = -1;
    double force = 0, displacement_per_unknown = 1;
  } point_load;
};

struct PathOptions
{
  bool arc_length = true;     ///< false: the table's loads are prescribed one after the other
  double first_load = 0.005;  ///< load factor of the first step of an arc-length path
  double largest_step = 0.05; ///< growth of load or any observed displacement, in units of its largest tabulated value
  int max_iterations = 15;    ///< of Newton's method in a step of the path: thin shells in bending take more
  int max_points = 400;
  /// Is this row (from 0) compared by the load at its displacement? All others: by the displacements at their load.
  bool (*at_displacement)(int row) = [](int) { return false; };
};

/// A table's rows (load factor, displacements) and what was computed there.
struct CurveComparison
{
  std::vector<std::vector<double>> table, computed; ///< same sizes; what was prescribed is equal in both
  int n_unknowns = 0, n_points = 0, n_iterations = 0;
  double cpu_seconds = 0;

  /// Largest |computed - table| in a column (0: load) over the rows with begin < load <= end, as a fraction of the
  /// column's largest entry.
  double largest_difference(int column, double begin = -1e9, double end = 1e9) const;
};

/// Follows the loaded shell along `table`: from rest by arc length (PathControl over the mid-surface), stopping at each
/// row where the path crosses it, or by prescribed loads. Throws std::runtime_error when a step or a row fails.
CurveComparison follow_table(LoadedShell &loaded, const std::vector<std::vector<double>> &table,
                             const PathOptions &options);
} // namespace pelvireg::reference_fe
