// The published shell tables at every tabulated load, on the meshes that run short; shell_study has the finer ones.
#include "tests/verification/reference_fe/shell/sze2004.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <numbers>
#include <ostream>

namespace pelvireg::reference_fe
{
namespace
{
struct StatedMesh
{
  const char *name;
  CellCounts cells;
  double to_half, beyond; ///< bounds of the differences below and above SzeCase::half, on this mesh
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

// Short runs; where a bound is wider than SzeCase's, shell_study has the mesh that meets it. The cantilevers' tables:
// see below.
INSTANTIATE_TEST_SUITE_P(, Sze2004,
                         ::testing::Values(StatedMesh{"end shear", {8, 1, 2}, 1.3e-3, 1.3e-3},
                                           StatedMesh{"end moment", {16, 1, 2}, 1.5e-3, 1.5e-3},
                                           StatedMesh{"slit annulus", {48, 6, 2}, 5e-3, 5e-3},
                                           StatedMesh{"hemisphere", {8, 8, 3}, 1e-2, 1e-2},
                                           StatedMesh{"pull-out", {12, 8, 2}, 5e-3, 1.7e-2},
                                           StatedMesh{"semi-cylinder", {12, 12, 2}, 1.5e-2, 1.5e-2},
                                           StatedMesh{"roof 12.7", {6, 6, 2}, 1e-2, 1e-2},
                                           StatedMesh{"roof 6.35", {6, 6, 2}, 1e-2, 1e-2}),
                         test_name);

TEST_P(Sze2004, EveryRowOfTheTableIsMet)
{
  const SzeCase &sze = sze_case(GetParam().name);
  const CurveComparison comparison = sze.compare(GetParam().cells);
  ASSERT_EQ(comparison.computed.size(), sze.table().size());
  std::cout << fmt::format("{}: {} unknowns, {} points, {} iterations\n", sze.name, comparison.n_unknowns,
                           comparison.n_points, comparison.n_iterations);
  for (int column = 0; column < static_cast<int>(comparison.table[0].size()); ++column)
  {
    const double to_half = comparison.largest_difference(column, -1e9, sze.half),
                 beyond = comparison.largest_difference(column, sze.half, 1e9);
    std::cout << fmt::format("  column {}: {:.3f} %, {:.3f} %\n", column, 100 * to_half, 100 * beyond);
    EXPECT_LE(to_half, GetParam().to_half) << "column " << column;
    EXPECT_LE(beyond, GetParam().beyond) << "column " << column;
  }
}

using ClosedForm = Eigen::Vector2d (*)(double factor);

/// Largest differences from a closed form, as fractions of the table's largest entries.
Eigen::Vector2d from_closed_form(const std::string &name, const CellCounts &cells, ClosedForm closed_form)
{
  const CurveComparison comparison = sze_case(name).compare(cells);
  Eigen::Vector2d largest = Eigen::Vector2d::Zero(), scale = largest;
  for (std::size_t row = 0; row < comparison.table.size(); ++row)
  {
    const Eigen::Vector2d computed(comparison.computed[row][1], comparison.computed[row][2]);
    const Eigen::Vector2d expected = closed_form(comparison.table[row][0]);
    largest = largest.cwiseMax((computed - expected).cwiseAbs());
    scale = scale.cwiseMax(expected.cwiseAbs());
  }
  largest.array() /= scale.array();
  std::cout << fmt::format("{}, {} cells of order {}: from the closed form {:.4f} %, {:.4f} %\n", name, cells.n1,
                           cells.order, 100 * largest[0], 100 * largest[1]);
  return largest;
}

Eigen::Vector2d sheared(double factor)
{
  return elastica(4 * factor, 10, 1.2e6 * 1e-3 / 12);
}

Eigen::Vector2d bent(double factor)
{
  return rolled_up(2 * std::numbers::pi * factor, 12);
}

// The table is itself 0.10 % (3.286 against 3.2894) from the inextensible elastica: 16 straight beams integrated at one
// point give its 3.286 and 6.698. What is left of ours are the beam's axial and shear strains.
TEST(Cantilever, UnderEndShearFollowsTheElastica)
{
  for (const int n_cells : {8, 16})
    EXPECT_LE(from_closed_form("end shear", {n_cells, 1, 2}, sheared).maxCoeff(), 3e-4);
}

// The circle is inextensible and of a linear M(kappa). With St. Venant and Kirchhoff's law and s = kappa^2 h^2 / 12 the
// moment is about E I kappa (1 - 3.6 s) and the axis shortens by 1.5 s: at full turn 0.08 % and 0.03 %. That explains
// the larger part of the distance; 0.05 % is left.
Eigen::Vector2d bent_with_finite_strain(double factor)
{
  const double length = 12, linear = 2 * std::numbers::pi * factor / length;
  double kappa = linear;
  for (int i = 0; i < 20; ++i)
    kappa = linear / (1 - 3.6 * kappa * kappa * 0.01 / 12);
  const double axis = 1 - 1.5 * kappa * kappa * 0.01 / 12;
  const Eigen::Vector2d circle = rolled_up(kappa * length, length);
  return {length - axis * (length - circle[0]), axis * circle[1]};
}

TEST(Cantilever, RollsUpToACircleUnderAnEndMoment)
{
  EXPECT_LE(from_closed_form("end moment", {16, 1, 3}, bent).maxCoeff(), 1.5e-3);
  EXPECT_LE(from_closed_form("end moment", {16, 1, 3}, bent_with_finite_strain).maxCoeff(), 1e-3);
}
} // namespace
} // namespace pelvireg::reference_fe
