#include "reference_fe/constraints/dead_load.h"
#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/elements/truss.h"
#include "reference_fe/newton_solver.h"
#include "synthetic/dataset/error.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <cmath>
#include <memory>

namespace pelvireg::reference_fe
{
namespace
{
const dataset::YeohMaterial wall = {0.1, 0.3, 0, 20};

SurfaceNode free_node(int first_unknown, const Eigen::Vector3d &at)
{
  SurfaceNode node;
  node.first_unknown = first_unknown;
  node.rest = at;
  return node;
}

TEST(Truss, StressIsTheDerivativeOfTheEnergyAndModulusOfTheStress)
{
  for (const double lambda : {0.6, 0.999, 1.001, 1.7})
  {
    const double step = 1e-6;
    const UniaxialResponse at = uniaxial_response(wall, lambda), plus = uniaxial_response(wall, lambda + step),
                           minus = uniaxial_response(wall, lambda - step);
    EXPECT_NEAR(at.stress, (plus.energy - minus.energy) / (2 * step), 1e-8) << lambda;
    EXPECT_NEAR(at.modulus, (plus.stress - minus.stress) / (2 * step), 1e-7) << lambda;
  }
  EXPECT_EQ(uniaxial_response(wall, 1).stress, 0);
  EXPECT_NEAR(uniaxial_response(wall, 1).modulus, 6 * wall.c10, 1e-14);
}

TEST(Truss, ATensionOnlyBarSlackensSmoothlyAndCarriesItsLawInTension)
{
  for (const double lambda : {0.6, 0.9, 0.999, 1.001, 1.004, 1.009, 1.011, 1.3})
  {
    const double step = 1e-6;
    const UniaxialResponse at = tension_only_response(wall, lambda), plus = tension_only_response(wall, lambda + step),
                           minus = tension_only_response(wall, lambda - step);
    EXPECT_NEAR(at.stress, (plus.energy - minus.energy) / (2 * step), 1e-8) << lambda;
    EXPECT_NEAR(at.modulus, (plus.stress - minus.stress) / (2 * step), 1e-5) << lambda;
    EXPECT_GT(at.modulus, 0) << lambda;
  }
  const double remainder = tension_only_remainder * 6 * wall.c10;
  EXPECT_EQ(tension_only_response(wall, 1).stress, 0);
  EXPECT_NEAR(tension_only_response(wall, 0.8).stress, -0.2 * remainder, 1e-15);
  EXPECT_NEAR(tension_only_response(wall, 1.3).stress,
              uniaxial_response(wall, 1.3 - tension_only_width / 2).stress + 0.3 * remainder, 1e-15);
}

TEST(Truss, NewtonsMethodConvergesAcrossTheSlackeningOfATensionOnlyBar)
{
  // A node between two cords in line, pulled along them beyond the point where one goes slack, and back.
  EquilibriumSystem system;
  const int first = system.add_unknowns(3, {"node"});
  system.fix(first + 1); // bars without stress hold nothing across their line
  system.fix(first + 2);
  Bar left{"", {free_node(first, {0, 0, 0})}, {-10, 0, 0}, 2, wall}, right = left;
  right.fixed_end = {10, 0, 0};
  left.tension_only = right.tension_only = true;
  system.add_term(std::make_shared<Trusses>(std::vector<Bar>{left, right}));
  const auto pull = std::make_shared<DeadLoad>(std::vector<std::pair<int, double>>{{first, 0.5}});
  system.add_term(pull);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(3);
  for (const double factor : {1., 0.1, -1., 0.})
  {
    pull->set_factor(factor);
    const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-10});
    EXPECT_TRUE(result.converged()) << factor << " " << result.message;
    const double taut = std::abs(solution[0]) / 10; // of the cord that carries
    EXPECT_NEAR(2 * tension_only_response(wall, 1 + taut).stress - 2 * tension_only_response(wall, 1 - taut).stress,
                0.5 * std::abs(factor), 1e-9);
  }
  EXPECT_NEAR(solution.norm(), 0, 1e-6);
}

TEST(Truss, ResidualAndTangentAgreeWithDifferenceQuotients)
{
  Bar between{"", {free_node(0, {0, 0, 0}), free_node(3, {3, 1, 2})}, {}, 2.5, wall};
  Bar to_point{"", {free_node(0, {0, 0, 0})}, {1, -2, 4}, 1.5, wall};
  Bar cord = between;
  cord.tension_only = true;
  const Trusses bars({between, to_point, cord});
  const Eigen::VectorXd solution = 0.5 * scattered(6, 11);
  for (const int item : {0, 1, 2})
  {
    EXPECT_LT(residual_error(bars, item, solution, 1e-5), 1e-7);
    EXPECT_LT(tangent_error(bars, item, solution, 1e-5), 1e-7);
  }
}

TEST(Truss, TheTwoBarTrussFollowsItsClosedFormThroughTheSnap)
{
  // Two bars of span b and rise h; the vertical force at height z is 2 A P(l/L) z/l.
  const double b = 10, h = 2, area = 3, length = std::hypot(b, h);
  const SurfaceNode apex = free_node(0, {0, 0, h});
  const Trusses bars({{"", {apex}, {-b, 0, 0}, area, wall}, {"", {apex}, {b, 0, 0}, area, wall}});
  for (const double z : {1.5, 0.5, 0.0, -0.7, -2.0, -3.0})
  {
    const Eigen::VectorXd solution = Eigen::Vector3d(0, 0, z - h);
    double force = 0;
    LocalSystem local;
    for (int item = 0; item < 2; ++item)
    {
      bars.evaluate(item, solution, local);
      force += local.residual[2];
    }
    const double l = std::hypot(b, z);
    EXPECT_NEAR(force, 2 * area * uniaxial_response(wall, l / length).stress * z / l, 1e-12) << z;
  }
}

TEST(QuadraticTetrahedron, ResidualAndTangentAgreeWithDifferenceQuotients)
{
  const dataset::ReferenceSolid block = block_solid(1, {1, 1.2, 0.9});
  const QuadraticTetrahedra term(block, wall, 0);
  const Eigen::VectorXd solution = 0.03 * scattered(3 * static_cast<int>(block.points.rows()), 12);
  for (const int item : {0, 3})
  {
    EXPECT_LT(residual_error(term, item, solution, 1e-5), 1e-6);
    EXPECT_LT(tangent_error(term, item, solution, 1e-5), 1e-6);
  }
}

TEST(QuadraticTetrahedron, AnInvertedOrFoldedCellIsRefused)
{
  const dataset::ReferenceSolid block = block_solid(1, {1, 1, 1});
  EXPECT_NO_THROW(QuadraticTetrahedra(block, wall, 0));
  dataset::ReferenceSolid mirrored = block;
  mirrored.points.col(0) *= -1;
  EXPECT_THROW(QuadraticTetrahedra(mirrored, wall, 0), InputError);
  // Corners exchanged without their mid-side nodes: the Jacobian is positive at all four integration points.
  dataset::ReferenceSolid exchanged = block;
  exchanged.cells.row(2).head<2>().reverseInPlace();
  EXPECT_THROW(QuadraticTetrahedra(exchanged, wall, 0), InputError);
}

TEST(QuadraticTetrahedron, AMidSideNodeMayMoveAQuarterOfItsEdgeAndNoFarther)
{
  // x(t) = t + 4 a t (1 - t) along the edge has no slope at its far end when a = 1/4 (the quarter-point element).
  for (const double beyond : {-1e-9, 1e-9})
  {
    dataset::ReferenceSolid tetrahedron = block_solid(1, {1, 1, 1});
    tetrahedron.cells = dataset::Tets10(tetrahedron.cells.topRows(1));
    const auto cell = tetrahedron.cells.row(0);
    const Eigen::RowVector3d edge = tetrahedron.points.row(cell[1]) - tetrahedron.points.row(cell[0]);
    tetrahedron.points.row(cell[4]) += (0.25 + beyond) * edge;
    if (beyond < 0)
      EXPECT_NO_THROW(QuadraticTetrahedra(tetrahedron, wall, 0));
    else
      EXPECT_THROW(QuadraticTetrahedra(tetrahedron, wall, 0), InputError);
  }
}

/// A block pulled to `lambda` along x, its sides free: the nominal stress in x.
double pulled_block_stress(const dataset::YeohMaterial &material, double lambda)
{
  const dataset::ReferenceSolid block = block_solid(2, {2, 1, 1});
  EquilibriumSystem system;
  const int n = static_cast<int>(block.points.rows());
  system.add_unknowns(3 * n, {"block"});
  system.add_term(std::make_shared<QuadraticTetrahedra>(block, material, 0));
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(3 * n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k)
    {
      const double x = block.points(i, k);
      solution[3 * i + k] = (k == 0 ? lambda - 1 : 1 / std::sqrt(lambda) - 1) * x;
      if (x < 1e-9 || (k == 0 && x > 2 - 1e-9))
        system.fix(3 * i + k);
    }
  EXPECT_TRUE(solve_newton(system, solution, {.residual_tolerance = 1e-12}).converged());
  double force = 0;
  for (int i = 0; i < n; ++i)
    if (block.points(i, 0) > 2 - 1e-9)
      force += system.residual()[3 * i];
  return force;
}

/// Closed form for a Yeoh law of bulk modulus kappa. With stretches lambda, t, t: J = lambda t^2, I1bar = J^(-2/3)
/// (lambda^2 + 2 t^2), W = C10 e + C20 e^2 + kappa/2 (J - 1)^2, e = I1bar - 3. The sides are free: dW/dt = 0 gives t by
/// bisection; the stress is dW/dlambda.
double compressible_stress(const dataset::YeohMaterial &m, double lambda)
{
  const auto slope = [&](double t, bool along)
  {
    const double j = lambda * t * t, trace = lambda * lambda + 2 * t * t;
    const double d_trace = along ? 2 * lambda : 4 * t, d_j = along ? t * t : 2 * lambda * t;
    const double e = trace / std::cbrt(j * j) - 3;
    const double d_e = (d_trace - 2. / 3 * trace * d_j / j) / std::cbrt(j * j);
    return (m.c10 + 2 * m.c20 * e) * d_e + m.kappa * (j - 1) * d_j;
  };
  double low = 0.5 / std::sqrt(lambda), high = 2 / std::sqrt(lambda);
  for (int i = 0; i < 100; ++i)
    (slope((low + high) / 2, false) < 0 ? low : high) = (low + high) / 2;
  return slope((low + high) / 2, true);
}

TEST(QuadraticTetrahedron, AUniaxiallyPulledBlockFollowsTheClosedForm)
{
  for (const double lambda : {0.8, 1.1, 1.4})
    EXPECT_NEAR(pulled_block_stress(wall, lambda), compressible_stress(wall, lambda), 1e-10) << lambda;
}

TEST(QuadraticTetrahedron, AUniaxiallyPulledBlockApproachesTheBarsIncompressibleLawAsKappaGrows)
{
  // First order in 1/kappa. At kappa/(2 C10) = 100 and lambda 1.4 it is 3.5 % below: C20 stiffens the wall threefold.
  for (const double lambda : {0.8, 1.1, 1.4})
  {
    dataset::YeohMaterial material = wall;
    double error[2];
    for (double &e : error)
    {
      material.kappa *= 100;
      e = std::abs(pulled_block_stress(material, lambda) / uniaxial_response(wall, lambda).stress - 1);
    }
    EXPECT_LT(error[0], 5e-4) << lambda;
    EXPECT_NEAR(error[0] / error[1], 100, 5) << lambda;
  }
}

TEST(QuadraticTetrahedron, AHomogeneousDeformationPassesThePatchTest)
{
  // Interior nodes of an affinely deformed block carry no residual.
  const dataset::ReferenceSolid block = block_solid(2, {1, 1, 1});
  const int n = static_cast<int>(block.points.rows());
  Eigen::Matrix3d gradient;
  gradient << 0.1, 0.05, -0.02, 0.03, -0.04, 0.06, 0.02, 0.01, -0.05;
  Eigen::VectorXd solution(3 * n);
  for (int i = 0; i < n; ++i)
    solution.segment<3>(3 * i) = gradient * block.points.row(i).transpose();
  EquilibriumSystem system;
  system.add_unknowns(3 * n, {"block"});
  system.add_term(std::make_shared<QuadraticTetrahedra>(block, wall, 0));
  system.assemble(solution, false);
  double interior = 0, boundary = 0;
  for (int i = 0; i < n; ++i)
  {
    const bool inside = (block.points.row(i).array() > 1e-9).all() && (block.points.row(i).array() < 1 - 1e-9).all();
    double &largest = inside ? interior : boundary;
    largest = std::max(largest, system.residual().segment<3>(3 * i).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(interior, 1e-12);
  EXPECT_GT(boundary, 1e-3);
}
} // namespace
} // namespace pelvireg::reference_fe
