// Large rotations: the corotational elements against the reference solver's quadratic tetrahedra at finite strain. Only
// a test may link both.
#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/newton_solver.h"
#include "registration/solver/body_solver.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"
#include "tests/unit/registration/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace pelvireg
{
namespace
{
constexpr double length = 80, width = 4;               // mm, square section
constexpr double youngs_modulus = 0.5, poisson = 0.45; // MPa
/// F L^2 / (E I) = 4: an inextensible elastica turns its tip by 64 degrees and lowers it by 0.67 of its length.
constexpr double load = 4 * youngs_modulus * (width * width * width * width / 12) / (length * length); // N, along z

/// Mean displacement of the nodes in a cross-section, mm, by the section's place along the beam.
using Sections = std::map<double, Eigen::Vector3d>;

template <class Positions, class Displacement>
Sections mean_sections(const Positions &rest, const Displacement &displacement)
{
  Sections sums;
  std::map<double, int> counts;
  for (Eigen::Index node = 0; node < rest.rows(); ++node)
  {
    const double place = std::round(rest(node, 0) * 1e6) / 1e6;
    sums.try_emplace(place, Eigen::Vector3d::Zero()).first->second += displacement(node);
    ++counts[place];
  }
  for (auto &[place, sum] : sums)
    sum /= counts[place];
  return sums;
}

Sections reference_beam()
{
  using namespace reference_fe;
  // Three bricks across: the pressure is constant in a cell, so with one it vanishes in bending and the beam is too
  // soft.
  const int n_across = 3;
  const dataset::ReferenceSolid solid = block_solid(Eigen::Vector3i(20, n_across, n_across), {length, width, width});
  const double mu = youngs_modulus / (2 * (1 + poisson)), kappa = youngs_modulus / (3 * (1 - 2 * poisson));
  EquilibriumSystem system;
  system.add_unknowns(3 * static_cast<int>(solid.points.rows()), {"solid"});
  system.add_term(std::make_shared<QuadraticTetrahedra>(solid, dataset::YeohMaterial{mu / 2, 0, 0, kappa}, 0));
  std::vector<std::pair<int, double>> forces;
  for (int node = 0; node < static_cast<int>(solid.points.rows()); ++node)
    if (solid.points(node, 0) < 1e-9)
      for (int axis = 0; axis < 3; ++axis)
        system.fix(3 * node + axis);
    else if (solid.points(node, 0) > length - 1e-9)
      forces.emplace_back(3 * node + 2, load / ((2 * n_across + 1) * (2 * n_across + 1)));
  const auto dead_load = std::make_shared<DeadLoad>(forces);
  system.add_term(dead_load);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(system.n_unknowns());
  for (int part = 1; part <= 8; ++part)
  {
    dead_load->set_factor(part / 8.0);
    const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-10, .max_iterations = 40});
    EXPECT_TRUE(result.converged()) << result.message;
  }
  return mean_sections(solid.points, [&](Eigen::Index node) { return solution.segment<3>(3 * node); });
}

/// Steps of the registration's own kind, the load being a row with a constant multiplier.
Sections corotational_beam(const Eigen::Vector3i &n, bool tetrahedral)
{
  using namespace registration;
  Body body = scene::block({length, width, width}, n, tetrahedral);
  body.youngs_modulus = youngs_modulus;
  body.poisson_ratio = poisson;
  ConstraintRows rows;
  rows.add_row(RowKind::sliding, 0, 0);
  for (int node = 0; node < static_cast<int>(body.rest_positions.rows()); ++node)
    if (body.rest_positions(node, 0) < 1e-9)
      body.fixed_nodes.push_back(node);
    else if (body.rest_positions(node, 0) > length - 1e-9)
      rows.add_entry({0, node, Eigen::Vector3d::UnitZ() / ((n[1] + 1) * (n[2] + 1))});
  constexpr double time_step = 0.05; // s; enough inertia for the first steps, and none at rest
  BodySolver solver(body, time_step);
  double motion = 1;
  for (int step = 0; step < 4000 && motion > 1e-7; ++step)
  {
    solver.assemble();
    EXPECT_TRUE(solver.factorise());
    solver.predict_free_motion();
    solver.gather_rows(rows, 0);
    solver.compute_compliance();
    EXPECT_TRUE(solver.correct(Eigen::VectorXd::Constant(1, load)));
    motion = (solver.corrected_positions() - solver.positions()).rowwise().norm().maxCoeff();
    solver.accept();
  }
  EXPECT_LE(motion, 1e-7);
  return mean_sections(body.rest_positions, [&](Eigen::Index node)
                       { return Eigen::Vector3d(solver.positions().row(node) - body.rest_positions.row(node)); });
}

/// Largest distance between the two axes over the sections that both have, in lengths of the beam.
double largest_difference(const Sections &a, const Sections &b)
{
  double largest = 0;
  int n_common = 0;
  for (const auto &[place, displacement] : a)
    if (const auto other = b.find(place); other != b.end())
    {
      largest = std::max(largest, (displacement - other->second).norm() / length);
      ++n_common;
    }
  EXPECT_GE(n_common, 10);
  return largest;
}
} // namespace

TEST(LargeRotation, OfACantileverIsThatOfTheReferenceSolver)
{
  const Sections reference = reference_beam();
  const Eigen::Vector3d tip = reference.rbegin()->second;
  RecordProperty("reference_tip", std::to_string(tip.z() / length));
  EXPECT_NEAR(tip.z() / length, 0.67, 0.01); // the elastica: the beam did turn
  const double hexahedra = largest_difference(corotational_beam({20, 1, 1}, false), reference);
  RecordProperty("hexahedra", std::to_string(hexahedra));
  EXPECT_LE(hexahedra, 0.02);
}
} // namespace pelvireg
