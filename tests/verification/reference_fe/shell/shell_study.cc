// The published shell tables on any mesh: one row a run, ready for docs/verification.md.
// usage: shell_study                          every case on its stated and its finer mesh
//        shell_study CASE                     one case on both
//        shell_study CASE N1 N2 ORDER [FILE]  one run; FILE.csv takes table and computed rows
#include "tests/verification/reference_fe/shell/sze2004.h"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

using namespace pelvireg::reference_fe;

namespace
{
struct StudyRun
{
  const char *name;
  CellCounts cells;
};

const std::vector<StudyRun> study = {
    {"end shear", {16, 1, 1}},         {"end shear", {8, 1, 2}},       {"end shear", {16, 1, 2}},
    {"end moment", {16, 1, 2}},        {"end moment", {16, 1, 3}},     {"slit annulus", {36, 4, 2}},
    {"slit annulus", {64, 8, 2}},      {"hemisphere", {12, 12, 2}},    {"hemisphere", {24, 24, 2}},
    {"pull-out", {12, 8, 3}},          {"pull-out", {24, 16, 2}},      {"pinched cylinder", {16, 16, 3}},
    {"pinched cylinder", {40, 40, 2}}, {"semi-cylinder", {12, 12, 3}}, {"semi-cylinder", {24, 24, 3}},
    {"roof 12.7", {6, 6, 3}},          {"roof 12.7", {12, 12, 3}},     {"roof 6.35", {6, 6, 3}},
    {"roof 6.35", {12, 12, 3}}};

/// Displacements' differences, a number a column, over some of the rows.
std::string displacement_differences(const CurveComparison &comparison, double begin, double end)
{
  std::string text;
  for (std::size_t column = 1; column < comparison.table[0].size(); ++column)
    text += fmt::format("{}{:.3f}", column > 1 ? ", " : "",
                        100 * comparison.largest_difference(static_cast<int>(column), begin, end));
  return text;
}

void print(const SzeCase &sze, const CellCounts &cells, const CurveComparison &comparison)
{
  std::string differences = displacement_differences(comparison, -1e9, sze.half);
  if (sze.half < 1e9)
    differences += " to half load; then " + displacement_differences(comparison, sze.half, 1e9);
  if (sze.options.at_displacement(0))
    differences = fmt::format("load {:.3f}; displacement {}", 100 * comparison.largest_difference(0), differences);
  std::cout << fmt::format("| {} | {} x {}, order {} | {} | {}, {} | {:.1f} | {} |", sze.name, cells.n1, cells.n2,
                           cells.order, comparison.n_unknowns, comparison.n_points, comparison.n_iterations,
                           comparison.cpu_seconds, differences)
            << std::endl;
}

void write(const CurveComparison &comparison, const std::string &file)
{
  std::ofstream out(file + ".csv");
  for (std::size_t row = 0; row < comparison.table.size(); ++row)
  {
    for (const double value : comparison.table[row])
      out << fmt::format("{},", value);
    for (const double value : comparison.computed[row])
      out << fmt::format("{:.6g},", value);
    out << "\n";
  }
}

void run(const SzeCase &sze, const CellCounts &cells, const std::string &file)
{
  const CurveComparison comparison = sze.compare(cells);
  print(sze, cells, comparison);
  if (!file.empty())
    write(comparison, file);
}
} // namespace

int main(int argc, char **argv)
{
  try
  {
    if (argc > 4)
      run(sze_case(argv[1]), {std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4])}, argc > 5 ? argv[5] : "");
    else
      for (const StudyRun &study_run : study)
        if (argc < 2 || std::string(argv[1]) == study_run.name)
          run(sze_case(study_run.name), study_run.cells, "");
  }
  catch (const std::exception &error)
  {
    std::cerr << "shell_study: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
