// The elements in structures with closed solutions.
#include "registration/solver/body_solver.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pelvireg::registration
{
namespace
{
constexpr double no_inertia = 1e6; // s: M / h^2 vanishes against K

/// Newton-like steps without constraints until the free motion fades.
void relax(BodySolver &solver, int n_steps)
{
  const ConstraintRows none;
  for (int step = 0; step < n_steps; ++step)
  {
    solver.assemble();
    ASSERT_TRUE(solver.factorise());
    solver.predict_free_motion();
    solver.gather_rows(none, 0);
    ASSERT_TRUE(solver.correct(Eigen::VectorXd()));
    solver.accept();
  }
}

/// Boundary nodes of a block of edge `size`.
std::vector<int> boundary_nodes(const Body &body, double size)
{
  std::vector<int> result;
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (const double x = body.rest_positions(node, axis); x < 1e-9 || x > size - 1e-9)
      {
        result.push_back(node);
        break;
      }
  return result;
}

/// Tip deflection (mm) of a cantilever along x under a load of 1 N across, spread over the tip's nodes; linear.
double tip_deflection(Body body, double length)
{
  std::vector<int> tip;
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    if (body.rest_positions(node, 0) < 1e-9)
      body.fixed_nodes.push_back(node);
    else if (body.rest_positions(node, 0) > length - 1e-9)
      tip.push_back(node);
  BodySolver solver(body, no_inertia);
  solver.assemble();
  EXPECT_TRUE(solver.factorise());
  // One row = the mean deflection of the tip, so that W is the deflection under a unit load spread evenly over it.
  ConstraintRows rows;
  rows.add_row(RowKind::sliding, 0, 0);
  for (const int node : tip)
    rows.add_entry({0, node, Eigen::Vector3d::UnitZ() / static_cast<double>(tip.size())});
  solver.gather_rows(rows, 0);
  solver.compute_compliance();
  return solver.compliance()(0, 0);
}

/// Timoshenko beam of square section b, shear factor 5/6.
double beam_deflection(double length, double b, double youngs_modulus, double poisson_ratio)
{
  const double inertia = std::pow(b, 4) / 12;
  const double shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
  return std::pow(length, 3) / (3 * youngs_modulus * inertia) + length / (5.0 / 6 * shear_modulus * b * b);
}

class PatchTest : public testing::TestWithParam<bool>
{
};
} // namespace

// MacNeal & Harder (Finite Elements in Analysis and Design 1, 1985): a patch of distorted elements whose boundary
// follows a homogeneous deformation takes that deformation inside, here a finite one with a rotation.
TEST_P(PatchTest, AHomogeneousDeformationOfTheBoundaryFillsADistortedPatch)
{
  const bool tetrahedral = GetParam();
  Body body = scene::block({12, 12, 12}, {3, 3, 3}, tetrahedral);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  body.fixed_nodes = boundary_nodes(body, 12);
  std::vector<char> is_fixed(body.rest_positions.rows(), 0);
  for (const int node : body.fixed_nodes)
    is_fixed[node] = 1;
  for (int node = 0; node < body.rest_positions.rows(); ++node)
    if (!is_fixed[node])
      body.rest_positions.row(node) += Eigen::RowVector3d(uniform(random), uniform(random), uniform(random));

  const Eigen::Matrix3d gradient = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) *
                                   (Eigen::Matrix3d() << 1.1, 0.05, 0, 0.05, 0.95, 0.02, 0, 0.02, 1.03).finished();
  const Points expected = body.rest_positions * gradient.transpose();
  Points start = expected;
  for (int node = 0; node < start.rows(); ++node)
    if (!is_fixed[node])
      start.row(node) += Eigen::RowVector3d(0.4, -0.3, 0.2);
  BodySolver solver(body, no_inertia);
  solver.set_positions(start);
  relax(solver, 40);
  EXPECT_LE((solver.positions() - expected).rowwise().norm().maxCoeff(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Elements, PatchTest, testing::Values(true, false),
                         [](const auto &instance) { return instance.param ? "Tetrahedra" : "Hexahedra"; });

// One hexahedron across the section is what the bands of the ligaments have. Without Poisson's effect only the length
// of the elements counts: 1 / (4 n^2) = 0.1 % for n = 16 elements. With nu = 0.45 the clamped end cannot contract and
// stiffens, by up to 1 / (1 - nu^2) = 1.25, about half a width of the beam where the moment is largest: 3 b / (2 L)
// 0.25 = 2.4 %.
TEST(Cantilever, OneHexahedronAcrossBendsAsTheBeamDoes)
{
  for (const auto &[poisson_ratio, tolerance] : {std::pair(0.0, 0.005), std::pair(0.45, 0.03)})
  {
    Body body = scene::block({64, 4, 4}, {16, 1, 1}, false);
    body.poisson_ratio = poisson_ratio;
    const double ratio = tip_deflection(body, 64) / beam_deflection(64, 4, body.youngs_modulus, poisson_ratio);
    RecordProperty("ratio", std::to_string(ratio));
    EXPECT_NEAR(ratio, 1, tolerance);
  }
}

// Linear tetrahedra lock in bending: too stiff by an excess that falls with h^2 (energy is second order). The reference
// is a fine mesh of hexahedra, itself within 5 % of the beam (L / b = 8: twice the effect of the clamp above).
TEST(Cantilever, TetrahedraConvergeWithTheSquareOfTheEdge)
{
  const double limit = tip_deflection(scene::block({32, 4, 4}, {32, 4, 4}, false), 32);
  EXPECT_NEAR(limit / beam_deflection(32, 4, 0.5, 0.45), 1, 0.05);
  double excess[3];
  for (int level = 0; level < 3; ++level)
  {
    const int n = 2 << level;
    excess[level] = limit / tip_deflection(scene::block({32, 4, 4}, {8 * n, n, n}, true), 32) - 1;
    RecordProperty("excess_stiffness_" + std::to_string(n), std::to_string(excess[level]));
  }
  EXPECT_NEAR(std::log2(excess[0] / excess[1]), 2, 0.3);
  EXPECT_NEAR(std::log2(excess[1] / excess[2]), 2, 0.3);
  EXPECT_GT(excess[2], 0); // a conforming element is never too soft
}

// A bar pulled along x with free sides: stress-free across, so W of the mean end displacement is L / (E A).
TEST(Bar, StretchesByLoadTimesLengthOverStiffness)
{
  for (const bool tetrahedral : {true, false})
  {
    const double length = 80;
    Body body = scene::block({length, 4, 4}, {20, 1, 1}, tetrahedral);
    ConstraintRows rows;
    rows.add_row(RowKind::sliding, 0, 0);
    for (int node = 0; node < body.rest_positions.rows(); ++node)
      if (body.rest_positions(node, 0) < 1e-9)
        body.fixed_nodes.push_back(node);
      else if (body.rest_positions(node, 0) > length - 1e-9)
        rows.add_entry({0, node, Eigen::Vector3d::UnitX() / 4});
    BodySolver solver(body, no_inertia);
    solver.assemble();
    ASSERT_TRUE(solver.factorise());
    solver.gather_rows(rows, 0);
    solver.compute_compliance();
    // The clamped end cannot contract over about one width: b / L x nu^2 = 1 %.
    EXPECT_NEAR(solver.compliance()(0, 0) / (length / (body.youngs_modulus * 16)), 1, 0.02);
  }
}
} // namespace pelvireg::registration
