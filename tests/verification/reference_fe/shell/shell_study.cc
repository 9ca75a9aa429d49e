// The published shell tables on any mesh: one row a run, ready for docs/verification.md.
// usage: shell_study                          every case on its stated and its finer mesh
//        shell_study CASE                     one case on both
//        shell_study CASE N1 N2 ORDER [FILE [ROWS]]
//                                             one run; FILE.csv takes the rows, standard error the path; ROWS: the
//                                             table's first rows alone
#include "tests/verification/reference_fe/shell/sze2004.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

using namespace pelvireg::reference_fe;

namespace
{
/// A case on the mesh that its figures are stated for, and on a finer one that shows how far that has converged.
struct Study
{
  const char *name;
  CellCounts stated, finer;
};

const std::vector<Study> studies = {
    {"end shear", {8, 1, 3}, {16, 1, 3}},        {"end shear, thinner", {8, 1, 3}, {16, 1, 3}},
    {"end moment", {8, 1, 3}, {16, 1, 3}},       {"end moment, thinner", {8, 1, 3}, {16, 1, 3}},
    {"slit annulus", {24, 4, 3}, {36, 6, 3}},    {"hemisphere", {8, 8, 3}, {14, 14, 3}},
    {"pull-out", {16, 12, 2}, {16, 12, 3}},      {"pinched cylinder", {24, 24, 2}, {38, 26, 2}},
    {"semi-cylinder", {12, 12, 3}, {16, 16, 3}}, {"roof 12.7", {8, 8, 3}, {12, 12, 3}},
    {"roof 6.35", {12, 12, 3}, {16, 16, 3}}};

/// Percent, a number a displacement column, over rows of one kind; empty when there is none.
std::string differences(const CurveComparison &comparison, bool at_displacement, double begin, double end)
{
  std::string text;
  double sum = 0;
  for (int column = 0; column < comparison.n_columns(); ++column)
  {
    const double difference = 100 * comparison.largest_difference(column, at_displacement, begin, end);
    sum += difference;
    text += fmt::format("{}{:.3f}", column > 0 ? ", " : "", difference);
  }
  return sum > 0 ? text + (at_displacement ? " of the largest load" : "") : "";
}

std::string both(const CurveComparison &comparison, double begin, double end)
{
  const std::string by_load = differences(comparison, false, begin, end),
                    by_displacement = differences(comparison, true, begin, end);
  return by_load + (by_load.empty() || by_displacement.empty() ? "" : "; ") + by_displacement;
}

void print(const SzeCase &sze, const CellCounts &cells, const CurveComparison &comparison)
{
  std::string text = both(comparison, -1e9, sze.half);
  if (sze.half < 1e9)
    text += " to half load; then " + both(comparison, sze.half, 1e9);
  std::cout << fmt::format("| {} | {} x {}, order {} | {} | {}, {} | {:.1f} | {} |", sze.name, cells.n1, cells.n2,
                           cells.order, comparison.n_unknowns, comparison.n_points, comparison.n_iterations,
                           comparison.cpu_seconds, text)
            << std::endl;
}

/// The table's row, what was computed there, the differences in percent, a line a row.
void write(const CurveComparison &comparison, const std::string &file)
{
  std::ofstream out(file + ".csv");
  for (int row = 0; row < static_cast<int>(comparison.rows.size()); ++row)
  {
    const ComparedRow &compared = comparison.rows[row];
    if (compared.computed.empty())
      continue; // not followed
    for (const double value : compared.table)
      out << fmt::format("{},", value);
    out << (compared.at_displacement ? "load" : "displacement");
    for (const double value : compared.computed)
      out << fmt::format(",{:.6g}", value);
    for (int column = 0; column < comparison.n_columns(); ++column)
      out << fmt::format(",{:.3f}", 100 * comparison.difference(row, column));
    out << "\n";
  }
}

/// Percent, a number a column: the largest distance between two meshes at a row, in the units of that row.
std::string between(const CurveComparison &coarse, const CurveComparison &fine)
{
  std::string text;
  for (int column = 0; column < fine.n_columns(); ++column)
  {
    double largest = 0;
    for (std::size_t row = 0; row < fine.rows.size(); ++row)
    {
      const double scale = fine.largest_entry(fine.rows[row].at_displacement ? 0 : column + 1);
      largest =
          std::max(largest, std::abs(fine.rows[row].computed[column] - coarse.rows[row].computed[column]) / scale);
    }
    text += fmt::format("{}{:.3f}", column > 0 ? ", " : "", 100 * largest);
  }
  return text;
}

CurveComparison run(const SzeCase &sze, const CellCounts &cells, const std::string &file, int n_rows = 1000)
{
  const auto log = [](const std::string &line) { std::cerr << line << "\n"; };
  CurveComparison comparison = sze.compare(cells, file.empty() ? PathLog() : log, n_rows);
  print(sze, cells, comparison);
  if (!file.empty())
    write(comparison, file);
  return comparison;
}

void run(const Study &study)
{
  const SzeCase &sze = sze_case(study.name);
  const CurveComparison stated = run(sze, study.stated, ""), finer = run(sze, study.finer, "");
  std::cout << "  between the two: " << between(stated, finer) << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  try
  {
    if (argc > 4)
      run(sze_case(argv[1]), {std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4])}, argc > 5 ? argv[5] : "",
          argc > 6 ? std::atoi(argv[6]) : 1000);
    else
      for (const Study &study : studies)
        if (argc < 2 || std::string(argv[1]) == study.name)
          run(study);
  }
  catch (const std::exception &error)
  {
    std::cerr << "shell_study: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
