// Patch tests of the shell at strains of 1e-8: membrane, bending and transverse shear. The irregular patch is that of
// MacNeal and Harder, Finite Elements in Analysis and Design 1 (1985) 3-20.
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace pelvireg::reference_fe
{
namespace
{
// Strains of 1e-8: what is nonlinear in them is sixteen times this, relatively.
constexpr double e = 1e-8;
constexpr double length = 0.24, width = 0.12, thickness = 1e-3;

/// Five cells, four of them irregular.
ShellBody irregular_patch(int order)
{
  Eigen::Matrix2Xd vertices(2, 8);
  vertices.row(0) << 0, length, 0, length, 0.04, 0.18, 0.08, 0.16;
  vertices.row(1) << 0, 0, width, width, 0.02, 0.03, 0.08, 0.08;
  Eigen::Matrix4Xi cells(4, 5);
  cells.col(0) << 0, 1, 4, 5;
  cells.col(1) << 1, 3, 5, 7;
  cells.col(2) << 4, 5, 6, 7;
  cells.col(3) << 0, 4, 2, 6;
  cells.col(4) << 6, 7, 2, 3;
  return flat_shell(vertices, cells, order, thickness);
}

/// 3 x 3 parallelograms.
ShellBody regular_patch(int order)
{
  Eigen::Matrix2Xd parameters;
  return structured_shell(
      3, 3, order, thickness,
      [](double s, double t) { return Eigen::Vector3d(length * (s + 0.3 * t), width * (t + 0.1 * s), 0); }, parameters);
}

std::unique_ptr<SingleShell> patch(ShellBody (*make)(int), int order)
{
  const ShellBody body = make(order);
  return std::make_unique<SingleShell>(body, body.midsurface.topRows<2>(),
                                       std::make_shared<SaintVenantKirchhoff>(1e6, 0.25), false);
}

/// Nodes on the border: those of edges that belong to one cell.
std::vector<int> border_nodes(const SingleShell &shell, bool irregular)
{
  return shell.nodes_where(
      [irregular](double x, double y)
      {
        double s = x / length, t = y / width;
        if (!irregular)
        {
          const double det = 1 - 0.3 * 0.1; // inverse of the shear
          const double a = (s - 0.3 * t) / det, b = (t - 0.1 * s) / det;
          s = a;
          t = b;
        }
        return std::min({s, t, 1 - s, 1 - t}) < 1e-9;
      });
}

using Field = Eigen::Vector3d (*)(const Eigen::Vector3d &);

/// Largest distance of the free mid-surface displacements from `field` when the border follows it, in units of the
/// field's largest value. `director`: its change that goes with the field. `directors_held`: in the inside too.
double difference(ShellBody (*make)(int), int order, Field field, Field director, bool directors_held = false)
{
  const auto shell = patch(make, order);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shell->system.n_unknowns());
  const auto prescribe = [&](int node, int first, int count, const Eigen::Vector3d &value)
  {
    for (int k = 0; k < count; ++k)
    {
      x[shell->unknown(node, first + k)] = value[k];
      shell->fix({node}, {first + k});
    }
  };
  for (const int node : border_nodes(*shell, make == irregular_patch))
  {
    prescribe(node, 0, 3, field(shell->body.midsurface.col(node)));
    prescribe(node, 3, 2, director(shell->body.midsurface.col(node))); // its length along z stays free
  }
  for (int node = 0; directors_held && node < shell->body.n_nodes(); ++node)
    prescribe(node, 3, 3, director(shell->body.midsurface.col(node)));
  shell->system.assemble(x, true);
  EXPECT_TRUE(shell->system.factorise());
  x += shell->system.solve(-shell->system.residual());
  double largest = 0, scale = 0;
  for (int node = 0; node < shell->body.n_nodes(); ++node)
  {
    const Eigen::Vector3d expected = field(shell->body.midsurface.col(node));
    largest = std::max(largest, (x.segment<3>(shell->unknown(node, 0)) - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  return largest / scale;
}

Eigen::Vector3d nothing(const Eigen::Vector3d &)
{
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d membrane(const Eigen::Vector3d &p)
{
  return {e * (p[0] + p[1] / 2), e * (p[1] + p[0] / 2), 0};
}

Eigen::Vector3d bending(const Eigen::Vector3d &p)
{
  return {0, 0, e * (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]) / 2};
}

Eigen::Vector3d bending_director(const Eigen::Vector3d &p)
{
  return {-e * (p[0] + p[1] / 2), -e * (p[1] + p[0] / 2), 0};
}

/// Constant transverse shear: the surface leans, the directors stay. They are held, for no plate is in equilibrium so
/// without distributed moments.
Eigen::Vector3d leaning(const Eigen::Vector3d &p)
{
  return {0, 0, e * (p[0] + p[1] / 2)};
}

struct PatchDifferences
{
  double membrane, bending, shear;
};

PatchDifferences patch_differences(const std::string &name, ShellBody (*make)(int), int order)
{
  const PatchDifferences found = {difference(make, order, membrane, nothing),
                                  difference(make, order, bending, bending_director),
                                  difference(make, order, leaning, nothing, true)};
  std::cout << fmt::format("{}, order {}: membrane {:.1e}, bending {:.1e}, transverse shear {:.1e}\n", name, order,
                           found.membrane, found.bending, found.shear);
  return found;
}

// Assumed strains hold a constant strain exactly; the forces of a constant stress are those of the displacements only
// where the cells' base vectors are constant: a sampled membrane shear (E12) has the wrong mean on a cell whose area
// element varies. Irregular cells are therefore off.
TEST(ShellPatch, ParallelogramsAreExact)
{
  for (const int order : {2, 3})
  {
    const PatchDifferences found = patch_differences("parallelograms", regular_patch, order);
    EXPECT_LE(found.membrane, 1e-6);
    EXPECT_LE(found.bending, 1e-6);
    EXPECT_LE(found.shear, 2e-5); // round-off
  }
}

TEST(ShellPatch, IrregularCellsAreNearlyExact)
{
  for (const int order : {2, 3})
  {
    const PatchDifferences found = patch_differences("MacNeal and Harder's patch", irregular_patch, order);
    EXPECT_LE(found.membrane, 1e-2);
    EXPECT_LE(found.bending, 1e-4);
    EXPECT_LE(found.shear, 2e-5); // round-off
  }
}
} // namespace
} // namespace pelvireg::reference_fe
