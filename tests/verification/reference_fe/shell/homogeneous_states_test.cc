// Uniaxial tension, equibiaxial tension and pure shear of a shell patch, and a stretched tube with free edges, of every
// law, against the homogeneous solution with the same bulk modulus and against incompressible closed forms.
#include "reference_fe/materials/mooney_rivlin.h"
#include "reference_fe/materials/neo_hookean.h"
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "reference_fe/materials/yeoh.h"
#include "tests/verification/reference_fe/incompressible_wall.h"
#include "tests/verification/reference_fe/shell/shell_benchmark.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>

namespace pelvireg::reference_fe
{
namespace
{
enum class State
{
  uniaxial,
  equibiaxial,
  pure_shear
};

struct NamedLaw
{
  std::string name;
  std::shared_ptr<const HyperelasticLaw> law;
};

constexpr IncompressibleEnergy neo_hookean = {.c10 = 0.1}, mooney_rivlin = {.c10 = 0.07, .c01 = 0.03},
                               yeoh = {.c10 = 0.1, .c20 = 0.05, .c30 = 0.02};

NamedLaw rubber(const IncompressibleEnergy &e, double kappa_over_mu)
{
  const double kappa = kappa_over_mu * e.mu();
  if (e.c01 != 0)
    return {"Mooney-Rivlin", std::make_shared<MooneyRivlin>(e.c10, e.c01, kappa)};
  if (e.c20 != 0)
    return {"Yeoh", std::make_shared<Yeoh>(e.c10, e.c20, e.c30, kappa)};
  return {"neo-Hookean", std::make_shared<NeoHookean>(e.c10, kappa)};
}

/// Stretches and the nominal stress along 1, MPa.
struct Homogeneous
{
  Eigen::Vector3d stretch;
  double stress = 0;
};

Eigen::Vector3d principal_stresses(const HyperelasticLaw &law, const Eigen::Vector3d &stretch)
{
  Voigt strain = Voigt::Zero();
  strain.head<3>() = 0.5 * (stretch.array().square() - 1);
  return law.evaluate(strain).stress.head<3>();
}

/// The free stretch (3, and 2 with it in uniaxial tension) such that no stress acts along 3, by bisection.
Homogeneous homogeneous(const HyperelasticLaw &law, State state, double stretch)
{
  const auto stretches = [&](double free)
  {
    return Eigen::Vector3d(stretch, state == State::uniaxial ? free : (state == State::equibiaxial ? stretch : 1),
                           free);
  };
  double low = 0.3, high = 1.2;
  for (int i = 0; i < 60; ++i)
    (principal_stresses(law, stretches(0.5 * (low + high)))[2] < 0 ? low : high) = 0.5 * (low + high);
  const Eigen::Vector3d l = stretches(low);
  return {l, stretch * principal_stresses(law, l)[0]};
}

constexpr double thickness = 0.2;

/// Stretches that keep the volume.
Eigen::Vector3d isochoric_stretch(State state, double stretch)
{
  const double second = state == State::uniaxial ? 1 / std::sqrt(stretch) : (state == State::equibiaxial ? stretch : 1);
  return {stretch, second, 1 / (stretch * second)};
}

/// Nominal stress of the incompressible closed form.
double incompressible_stress(const IncompressibleEnergy &energy, State state, double stretch)
{
  const Eigen::Vector3d l = isochoric_stretch(state, stretch);
  return energy.stress_difference(l[0], l[2], l[1]) / l[0];
}

/// Moves all nodes of a shell in the x, y plane as these stretches would: where Newton's method begins.
void stretch_patch(const SingleShell &shell, const Eigen::Vector3d &stretch, Eigen::VectorXd &x)
{
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    x.segment<3>(shell.unknown(node, 0)) = (stretch.array() - 1) * shell.body.midsurface.col(node).array();
    x[shell.unknown(node, 5)] = stretch[2] - 1;
  }
}

/// Largest difference of stretches and nominal stress of a patch from the homogeneous state, relative. `bend`: how far
/// the inner vertices are moved from a rectangular net.
double patch_difference(const NamedLaw &named, State state, double stretch, double bend)
{
  static constexpr double along[4] = {0, 0.25, 0.6, 1}, across[4] = {0, 0.4, 0.7, 1};
  const auto vertex = [bend](int i, int j)
  {
    const double inside = i % 3 == 0 || j % 3 == 0 ? 0 : bend * (i == j ? 1 : -1);
    return Eigen::Vector3d(along[i] + inside, across[j] + inside / 2, 0);
  };
  const SurfaceMap map = straight_cells(3, 3, vertex);
  SingleShell shell(3, 3, 2, thickness, map, named.law, false);
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(starts_across), 1);
  shell.fix({corner(shell, 0, 0)}, {2});
  const std::vector<int> pulled = shell.nodes_where(ends);
  shell.fix(pulled, {0});
  if (state != State::uniaxial)
    shell.fix(shell.nodes_where(ends_across), {1});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  stretch_patch(shell, isochoric_stretch(state, stretch), x);
  const NewtonResult result = solve_newton(shell.system, x, {.residual_tolerance = 1e-12});
  EXPECT_TRUE(result.converged()) << result.message;
  const Homogeneous expected = homogeneous(*named.law, state, stretch);
  double reaction = 0;
  for (const int node : pulled)
    reaction += shell.system.residual()[shell.unknown(node, 0)];
  double largest = std::abs(reaction / thickness / expected.stress - 1);
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    const Eigen::Vector3d rest = shell.body.midsurface.col(node);
    const Eigen::Vector3d moved = rest + x.segment<3>(shell.unknown(node, 0));
    largest = std::max(largest, (moved - expected.stretch.cwiseProduct(rest)).norm());
    largest = std::max(largest, std::abs(1 + x[shell.unknown(node, 5)] - expected.stretch[2]));
  }
  return largest;
}

const std::pair<State, std::string> states[] = {
    {State::uniaxial, "uniaxial"}, {State::equibiaxial, "equibiaxial"}, {State::pure_shear, "pure shear"}};

// Rectangular cells of unequal sides are exact; irregular ones are not: assumed strains (see ShellPatch).
TEST(HomogeneousState, APatchOfEveryLawIsExact)
{
  for (const NamedLaw &named : {rubber(neo_hookean, 1000), rubber(mooney_rivlin, 1000), rubber(yeoh, 1000),
                                NamedLaw{"St. Venant-Kirchhoff", std::make_shared<SaintVenantKirchhoff>(1., 0.3)}})
    for (const auto &[state, name] : states)
    {
      const double stretch = named.name == "St. Venant-Kirchhoff" ? 1.2 : 1.5; // at 1.5 its thickness would be gone
      const double exact = patch_difference(named, state, stretch, 0),
                   irregular = patch_difference(named, state, stretch, 0.05);
      std::cout << fmt::format("{}, {}, stretch {}: rectangular cells {:.1e}, irregular {:.1e}\n", named.name, name,
                               stretch, exact, irregular);
      EXPECT_LE(exact, 1e-6) << named.name << " " << name;
      EXPECT_LE(irregular, 2e-3) << named.name << " " << name;
    }
}

TEST(HomogeneousState, ApproachesIncompressibilityAsTheBulkModulusGrows)
{
  for (const IncompressibleEnergy &energy : {neo_hookean, mooney_rivlin, yeoh})
    for (const auto &[state, name] : states)
    {
      const double closed = incompressible_stress(energy, state, 1.3);
      const auto difference = [&, state = state](double kappa_over_mu)
      { return homogeneous(*rubber(energy, kappa_over_mu).law, state, 1.3).stress / closed - 1; };
      const double soft = difference(1000), stiff = difference(4000);
      std::cout << fmt::format("{}, {}: {:+.4f} % from incompressibility at kappa/mu 1000, {:+.4f} % at 4000\n",
                               rubber(energy, 1).name, name, 100 * soft, 100 * stiff);
      EXPECT_LE(std::abs(soft), energy.c20 != 0 && state == State::equibiaxial ? 1e-2 : 2e-3);
      EXPECT_LE(std::abs(stiff), 0.3 * std::abs(soft));
    }
}

struct TubeDifferences
{
  double force = 0, radius = 0, wall = 0; ///< largest, relative
};

/// A quarter of a tube, stretched along its axis with nothing on its free edges: uniaxial tension.
TubeDifferences tube_differences(const NamedLaw &named, int n_cells, double stretch)
{
  const double radius = 10, wall = 1, length = 5;
  SingleShell shell(n_cells, 2, 2, wall, cylinder(radius, std::numbers::pi / 2, length), named.law, false);
  mirror(shell, shell.nodes_where(begins), 0);
  mirror(shell, shell.nodes_where(ends), 2);
  mirror(shell, shell.nodes_where(starts_across), 1);
  const std::vector<int> pulled = shell.nodes_where(ends_across);
  shell.fix(pulled, {1, 4}); // the section stays plane
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shell.system.n_unknowns());
  const double across = 1 / std::sqrt(stretch) - 1; // where Newton's method begins: as if the volume were kept
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    x.segment<3>(shell.unknown(node, 0)) =
        Eigen::Array3d(across, stretch - 1, across) * shell.body.midsurface.col(node).array();
    x.segment<3>(shell.unknown(node, 3)) = across * shell.body.director.col(node);
  }
  const NewtonResult result = solve_newton(shell.system, x, {.residual_tolerance = 1e-10});
  EXPECT_TRUE(result.converged()) << result.message;
  const Homogeneous expected = homogeneous(*named.law, State::uniaxial, stretch);
  TubeDifferences found;
  double force = 0;
  for (const int node : pulled)
    force += shell.system.residual()[shell.unknown(node, 1)];
  found.force = std::abs(force / (std::numbers::pi / 2 * radius * wall * expected.stress) - 1);
  for (int node = 0; node < shell.body.n_nodes(); ++node)
  {
    const Eigen::Vector3d moved = shell.body.midsurface.col(node) + x.segment<3>(shell.unknown(node, 0));
    found.radius =
        std::max(found.radius, std::abs(std::hypot(moved[0], moved[2]) / (radius * expected.stretch[1]) - 1));
    const double director = (shell.body.director.col(node) + x.segment<3>(shell.unknown(node, 3))).norm();
    found.wall = std::max(found.wall, std::abs(director / expected.stretch[2] - 1));
  }
  return found;
}

TEST(HomogeneousState, AStretchedTubeWithFreeEdgesIsUniaxialTension)
{
  for (const IncompressibleEnergy &energy : {neo_hookean, mooney_rivlin, yeoh})
  {
    const NamedLaw named = rubber(energy, 1000);
    const TubeDifferences coarse = tube_differences(named, 6, 1.3), fine = tube_differences(named, 12, 1.3);
    std::cout << fmt::format(
        "tube, {}, stretch 1.3: 6 cells over the quarter: force {:.1e}, radius {:.1e}, wall {:.1e}; 12 "
        "cells {:.1e}, {:.1e}, {:.1e}\n",
        named.name, coarse.force, coarse.radius, coarse.wall, fine.force, fine.radius, fine.wall);
    EXPECT_LE(fine.force, 1e-6);
    EXPECT_LE(fine.radius, 1e-6);
    EXPECT_LE(fine.wall, 5e-4); // at the nodes: strains are assumed
    EXPECT_LE(fine.wall, coarse.wall / 3);
  }
}
} // namespace
} // namespace pelvireg::reference_fe
