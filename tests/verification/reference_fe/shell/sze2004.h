// Sze, Liu, Lo, Popular benchmark problems for geometric nonlinear analysis of shells, Finite Elements in Analysis and
// Design 40 (2004) 1551-1569: the eight problems, in the source's consistent units. The tables are of Abaqus S4R.
#pragma once

#include "tests/verification/reference_fe/shell/equilibrium_path.h"

#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
struct CellCounts
{
  int n1 = 1, n2 = 1, order = 2;
};

struct SzeCase
{
  std::string name, table_file;
  LoadedShell (*make)(const CellCounts &);
  PathOptions options;
  /// Displacements are asked within `bound` of their largest value up to the load factor `half`, within `bound_beyond`
  /// after it; a roof's loads within `bound` of the largest load.
  double bound = 5e-3, bound_beyond = 5e-3, half = 1e9;

  std::vector<std::vector<double>> table() const;
  /// Follows the table, or its first rows.
  CurveComparison compare(const CellCounts &cells, const PathLog &log = {}, int n_rows = 1000) const;
};

/// By name: "end shear", "end moment", "slit annulus", "hemisphere", "pull-out", "pinched cylinder", "semi-cylinder",
/// "roof 12.7", "roof 6.35".
const std::vector<SzeCase> &sze_cases();
const SzeCase &sze_case(const std::string &name); ///< throws std::out_of_range
} // namespace pelvireg::reference_fe
