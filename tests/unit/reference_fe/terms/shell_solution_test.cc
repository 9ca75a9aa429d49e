// What Newton's method and the assembly do with a shell: a small sphere, filled and held.
#include "reference_fe/constraints/cavity.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/yeoh.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <cmath>
#include <memory>

namespace pelvireg::reference_fe
{
namespace
{
struct FilledSphere
{
  EquilibriumSystem system;
  std::shared_ptr<ShellTerm> shell;
  std::shared_ptr<Cavity> fluid;

  FilledSphere(int n_threads, bool mixed) : system(n_threads)
  {
    const dataset::ReferenceShell sphere = sphere_shell(2, 10, 1);
    const ShellBody body = shell_body(sphere);
    const int first = add_shell_unknowns(system, body);
    shell = std::make_shared<ShellTerm>(body, std::make_shared<Yeoh>(0.1, 0.05, 0, 20), first, mixed);
    system.add_term(shell);
    std::vector<SurfaceFace> faces;
    for (Eigen::Index c = 0; c < sphere.cells.rows(); ++c)
      faces.push_back(shell_face(sphere, first, c, -1));
    const int pressure = system.add_unknowns(1, {"fluid pressure", 1e3});
    fluid = std::make_shared<Cavity>("fluid", faces, pressure);
    system.add_term(fluid);
    // One cell is glued to a wall, so that the rest bends.
    for (int k = 0; k < 9; ++k)
      for (int c = 0; c < n_shell_unknowns; ++c)
        system.fix(first + n_shell_unknowns * sphere.cells(0, k) + c);
  }
};

TEST(ShellSolution, NewtonsMethodWithTheExactTangentConvergesQuadratically)
{
  FilledSphere sphere(1, false);
  sphere.fluid->hold_volume(1.1 * sphere.fluid->rest_volume());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(sphere.system.n_unknowns());
  const NewtonResult result = solve_newton(sphere.system, x, {.residual_tolerance = 1e-9});
  ASSERT_TRUE(result.converged()) << result.message;
  std::vector<double> r;
  for (const NewtonIteration &iteration : result.iterations)
    r.push_back(iteration.residual);
  r.push_back(result.residual);
  // The order seen in the last three residuals above the round-off of some 1e-12 N.
  while (r.back() < 1e-11)
    r.pop_back();
  ASSERT_GE(r.size(), 4u);
  const std::size_t k = r.size() - 1;
  EXPECT_GT(std::log(r[k] / r[k - 1]) / std::log(r[k - 1] / r[k - 2]), 1.8);
}

TEST(ShellSolution, MixedIntegrationPointsReachTheSameSolution)
{
  Eigen::VectorXd x[2];
  for (const bool mixed : {false, true})
  {
    FilledSphere sphere(1, mixed);
    sphere.fluid->hold_volume(1.1 * sphere.fluid->rest_volume());
    x[mixed] = Eigen::VectorXd::Zero(sphere.system.n_unknowns());
    ASSERT_TRUE(solve_newton(sphere.system, x[mixed], {.residual_tolerance = 1e-10}).converged());
  }
  EXPECT_GT(x[0].cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((x[0] - x[1]).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(ShellSolution, OneAndTwoThreadsAssembleTheSameBytes)
{
  FilledSphere one(1, true), two(2, true);
  const Eigen::VectorXd x = 0.05 * scattered(one.system.n_unknowns(), 61), from = 0.9 * x;
  for (FilledSphere *sphere : {&one, &two})
  {
    sphere->system.linearise_at(from);
    sphere->system.assemble(x, true);
  }
  EXPECT_GT(one.system.residual().cwiseAbs().maxCoeff(), 0);
  EXPECT_TRUE(one.system.residual() == two.system.residual());
  EXPECT_EQ(one.system.tangent().value, two.system.tangent().value);
  EXPECT_EQ(one.system.energy(), two.system.energy());
}

TEST(ShellSolution, AFailedSolutionLeavesTheLastAcceptedIterateWithWhichItWasLinearised)
{
  FilledSphere sphere(1, false);
  sphere.fluid->hold_volume(1.1 * sphere.fluid->rest_volume());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(sphere.system.n_unknowns());
  Eigen::VectorXd x = rest;
  const NewtonResult one = solve_newton(sphere.system, x, {.residual_tolerance = 1e-9, .max_iterations = 1});
  EXPECT_EQ(one.status, NewtonStatus::too_many_iterations);
  EXPECT_GT(x.cwiseAbs().maxCoeff(), 0);
  // The residual that is reported is that of the iterate that is handed back.
  sphere.system.assemble(x, false);
  EXPECT_EQ(sphere.system.residual_norm(), one.residual);
  // A line search that may never accept hands the start back.
  Eigen::VectorXd y = rest;
  const NewtonResult none = solve_newton(sphere.system, y, {.residual_tolerance = 1e-9, .max_merit_growth = 1e-12});
  EXPECT_EQ(none.status, NewtonStatus::no_decrease);
  EXPECT_TRUE(y == rest);
}

TEST(ShellSolution, AFoldedTrialIsThrownAwayAndTheStepCutUntilNoCellIsInverted)
{
  // Ten times the volume at once: the first full step turns cells inside out.
  FilledSphere sphere(1, false);
  sphere.fluid->hold_volume(10 * sphere.fluid->rest_volume());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(sphere.system.n_unknowns());
  const NewtonResult result = solve_newton(sphere.system, x, {.residual_tolerance = 1e-9, .max_iterations = 1});
  ASSERT_EQ(result.iterations.size(), 1u);
  EXPECT_LT(result.iterations[0].step_length, 1);
  EXPECT_TRUE(std::isfinite(result.residual));
  EXPECT_GT(sphere.shell->smallest_jacobian(x), 0);
  // The next increment will be solved with the tangent of the point accepted, not of a trial.
  const std::vector<double> tangent = sphere.system.tangent().value;
  sphere.system.assemble(x, true);
  EXPECT_EQ(tangent, sphere.system.tangent().value);
}
} // namespace
} // namespace pelvireg::reference_fe
