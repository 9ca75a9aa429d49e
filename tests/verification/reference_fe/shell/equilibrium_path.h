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
  /// The tabulated displacements: unknowns of the shell, times the table's signs or units.
  std::vector<std::pair<int, double>> observed;
};

/// Takes one line a point of the path; may be empty.
using PathLog = std::function<void(const std::string &)>;

struct PathOptions
{
  bool arc_length = true;     ///< false: the table's loads are prescribed one after the other
  double first_load = 0.005;  ///< load factor of the first step of an arc-length path
  double largest_step = 0.05; ///< growth of load or any observed displacement, in units of its largest tabulated value
  int max_iterations = 15;    ///< of Newton's method in a step of the path: thin shells in bending take more
  int max_points = 400;
  int n_rows = 1000; ///< the rows that are followed; those after them keep no computed numbers
  /// Is this row (from 0) compared by the loads at its displacements? All others: by the displacements at their load.
  bool (*at_displacement)(int row) = [](int) { return false; };
  PathLog log = {};
};

/// A row of a table and what was computed there.
struct ComparedRow
{
  std::vector<double> table; ///< load factor, displacements
  bool at_displacement = false;
  /// A number a displacement column: the displacement at the row's load, or the load at the row's displacement.
  /// Empty: not followed.
  std::vector<double> computed;
};

struct CurveComparison
{
  std::vector<ComparedRow> rows;
  int n_unknowns = 0, n_points = 0, n_iterations = 0;
  double cpu_seconds = 0;

  /// |computed - table| of a displacement column (from 0), as a fraction of the column's largest entry, or of the
  /// largest load where the row is compared at its displacement.
  double difference(int row, int column) const;
  /// Largest of them over the rows of one kind with begin < load <= end; 0 when there is none.
  double largest_difference(int column, bool at_displacement, double begin = -1e9, double end = 1e9) const;
  /// Of a table's column (0: load), absolute.
  double largest_entry(std::size_t column) const;
  /// Displacement columns.
  int n_columns() const { return static_cast<int>(rows.at(0).table.size()) - 1; }
};

/// Follows the loaded shell along `table`: from rest by arc length (PathControl over the mid-surface), stopping at each
/// row where the path crosses it, or by prescribed loads. Throws std::runtime_error when a step or a row fails.
CurveComparison follow_table(LoadedShell &loaded, const std::vector<std::vector<double>> &table,
                             const PathOptions &options);
} // namespace pelvireg::reference_fe
