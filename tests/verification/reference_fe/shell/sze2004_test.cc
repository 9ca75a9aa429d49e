// The published shell tables at every tabulated load, on the meshes that run short; shell_study has the finer ones.
#include "tests/verification/reference_fe/shell/beams.h"
#include "tests/verification/reference_fe/shell/sze2004.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
struct StatedMesh
{
  const char *name;
  CellCounts cells;
  double to_half, beyond; ///< bounds of the differences below and above SzeCase::half, on this mesh
  int n_rows = 1000;      ///< followed
};

void PrintTo(const StatedMesh &mesh, std::ostream *out)
{
  *out << mesh.name;
}

class Sze2004 : public ::testing::TestWithParam<StatedMesh>
{
};

std::string test_name(const ::testing::TestParamInfo<StatedMesh> &info)
{
  std::string name = info.param.name;
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
}

// Short runs; where a bound is wider than SzeCase's, shell_study has the mesh that meets it, or docs/verification.md
// the reason. The cantilevers' tables: see below.
INSTANTIATE_TEST_SUITE_P(, Sze2004,
                         ::testing::Values(StatedMesh{"end shear", {8, 1, 2}, 1.3e-3, 1.3e-3},
                                           StatedMesh{"end moment", {16, 1, 2}, 1.5e-3, 1.5e-3},
                                           StatedMesh{"end moment, thinner", {8, 1, 3}, 2e-4, 2e-4},
                                           StatedMesh{"slit annulus", {48, 6, 2}, 5e-3, 5e-3},
                                           StatedMesh{"hemisphere", {8, 8, 3}, 1e-2, 1e-2},
                                           StatedMesh{"pull-out", {12, 8, 2}, 5e-3, 1.7e-2},
                                           StatedMesh{"pinched cylinder", {24, 24, 1}, 2e-2, 2e-2, 4},
                                           StatedMesh{"semi-cylinder", {12, 12, 2}, 1.5e-2, 1.5e-2},
                                           StatedMesh{"roof 12.7", {6, 6, 2}, 1e-2, 1e-2},
                                           StatedMesh{"roof 6.35", {6, 6, 2}, 2.2e-2, 2.2e-2}),
                         test_name);

TEST_P(Sze2004, EveryRowOfTheTableIsMet)
{
  const SzeCase &sze = sze_case(GetParam().name);
  const CurveComparison comparison = sze.compare(GetParam().cells, {}, GetParam().n_rows);
  ASSERT_EQ(comparison.rows.size(), sze.table().size());
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
    ASSERT_EQ(comparison.rows[row].computed.empty(), static_cast<int>(row) >= GetParam().n_rows) << "row " << row;
  std::cout << fmt::format("{}: {} unknowns, {} points, {} iterations\n", sze.name, comparison.n_unknowns,
                           comparison.n_points, comparison.n_iterations);
  for (int column = 0; column < comparison.n_columns(); ++column)
    for (const bool at_displacement : {false, true})
    {
      const double to_half = comparison.largest_difference(column, at_displacement, -1e9, sze.half),
                   beyond = comparison.largest_difference(column, at_displacement, sze.half, 1e9);
      std::cout << fmt::format("  column {}, {}: {:.3f} %, {:.3f} %\n", column,
                               at_displacement ? "load" : "displacement", 100 * to_half, 100 * beyond);
      EXPECT_LE(to_half, GetParam().to_half) << "column " << column;
      EXPECT_LE(beyond, GetParam().beyond) << "column " << column;
    }
}

using ClosedForm = TipDisplacement (*)(double factor);

/// Largest distances of two curves over the table's rows, as fractions of the table's largest entries.
template <typename First, typename Second>
Eigen::Vector2d largest_distances(const std::vector<std::vector<double>> &table, const First &first,
                                  const Second &second)
{
  Eigen::Vector2d largest = Eigen::Vector2d::Zero(), scale = largest;
  for (std::size_t row = 0; row < table.size(); ++row)
  {
    largest = largest.cwiseMax((first(row) - second(row)).cwiseAbs());
    scale = scale.cwiseMax(Eigen::Vector2d(table[row][1], table[row][2]).cwiseAbs());
  }
  return largest.cwiseQuotient(scale);
}

Eigen::Vector2d from_closed_form(const std::string &name, const CellCounts &cells, ClosedForm closed_form)
{
  const CurveComparison comparison = sze_case(name).compare(cells);
  const Eigen::Vector2d largest = largest_distances(
      sze_case(name).table(),
      [&](std::size_t row)
      { return Eigen::Vector2d(comparison.rows[row].computed[0], comparison.rows[row].computed[1]); },
      [&](std::size_t row) { return closed_form(comparison.rows[row].table[0]); });
  std::cout << fmt::format("{}, {} cells of order {}: from the closed form {:.4f} %, {:.4f} %\n", name, cells.n1,
                           cells.order, 100 * largest[0], 100 * largest[1]);
  return largest;
}

TipDisplacement sheared(double factor)
{
  return elastica(4 * factor, 10, 100);
}

TipDisplacement rolled(double factor)
{
  return rolled_strip_tip(50 * std::numbers::pi / 3 * factor, 12, 0.1, 1.2e6);
}

// What is left are the wall's own axial and shear strains: a quarter of the thickness at the same E I leaves nothing.
TEST(Cantilever, UnderEndShearFollowsTheElastica)
{
  for (const int n_cells : {8, 16})
    EXPECT_LE(from_closed_form("end shear", {n_cells, 1, 2}, sheared).maxCoeff(), 3e-4);
  EXPECT_LE(from_closed_form("end shear, thinner", {8, 1, 3}, sheared).maxCoeff(), 5e-5);
}

// The limit of 0.1 % of the end shear's table is below the table's own error: 16 straight beams, a row of the source's
// cells when nu = 0, give each of its 40 numbers; on finer meshes they go to the elastica.
TEST(Cantilever, TheTableOfTheEndShearIsThatOfSixteenStraightBeams)
{
  const std::vector<std::vector<double>> table = sze_case("end shear").table();
  const auto printed = [&](std::size_t row) { return Eigen::Vector2d(table[row][1], table[row][2]); };
  const auto beams = [&](int n)
  { return [&table, n](std::size_t row) { return straight_beams(4 * table[row][0], 10, 100, n); }; };
  const auto exact = [&](std::size_t row) { return sheared(table[row][0]); };
  EXPECT_LE(largest_distances(table, printed, beams(16)).maxCoeff(), 2e-4);
  const Eigen::Vector2d error = largest_distances(table, beams(16), exact),
                        of_finer = largest_distances(table, beams(32), exact);
  std::cout << fmt::format("the table lies {:.3f} % from the elastica, 16 beams {:.3f} %, 32 beams {:.3f} %\n",
                           100 * largest_distances(table, printed, exact)[0], 100 * error[0], 100 * of_finer[0]);
  EXPECT_GT(largest_distances(table, printed, exact)[0], 1e-3);
  EXPECT_NEAR(error[0] / of_finer[0], 4, 0.05);
}

// The table is the inextensible circle. A wall of St. Venant and Kirchhoff's law with the source's thickness is up to
// 0.14 % from it, at a surface strain of 2.6 %: that solution is exact, and ours is it. A quarter of the thickness at
// the same E I is the circle.
TEST(Cantilever, RollsUpAsTheExactSolutionOfTheStripDoes)
{
  EXPECT_LE(from_closed_form("end moment", {16, 1, 3}, rolled).maxCoeff(), 2e-5);
}

TEST(RolledStrip, IsSofterAndShorterThanTheLineOfItsMiddle)
{
  const double curvature = std::numbers::pi / 6, thickness = 0.1, s = std::pow(curvature * thickness, 2) / 12;
  const RolledStrip strip = rolled_strip(curvature, thickness, 1.2e6);
  EXPECT_NEAR(strip.moment / (100 * curvature) - 1, -6 * s, 0.01 * 6 * s);
  EXPECT_NEAR(strip.radius * curvature - 1, -1.5 * s, 0.01 * 1.5 * s);
}
} // namespace
} // namespace pelvireg::reference_fe
