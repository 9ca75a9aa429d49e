// Newton's method on the whole pelvis: shells, solid, bars, fluids, tie, contact and the load factor in one system.
#include "reference_fe/load_stepper.h"
#include "synthetic/anatomy/case.h"

#include <gtest/gtest.h>

#include <iostream>
#include <stdexcept>

namespace pelvireg::reference_fe
{
namespace
{
TEST(PelvisNewton, ConvergesQuadraticallyAndSaysSoLineByLine)
{
  const dataset::Anatomy anatomy = anatomy::build_anatomy(anatomy::case_text("quick"), "quick");
  PelvisModel model = build_pelvis_model(anatomy, 1);
  LoadStepper stepper(model, {});
  stepper.start(anatomy.reference.target_displacement);

  // From there half as much pressure again at once, every term with its exact tangent.
  Eigen::VectorXd x = stepper.solution();
  model.path->release();
  model.probe->prescribe_pressure(1.5 * x[model.pressure_unknown]);
  for (const std::shared_ptr<ShellTerm> &shell : model.shells)
    shell->use_mixed_integration_points(false);
  std::vector<std::string> log;
  const NewtonResult result = solve_newton(
      model.system, x, {.residual_tolerance = 1e-9, .log = [&](const std::string &line) { log.push_back(line); }});
  ASSERT_TRUE(result.converged()) << result.message;
  ASSERT_EQ(log.size(), result.iterations.size());
  std::vector<double> residuals;
  for (std::size_t i = 0; i < log.size(); ++i)
  {
    std::cout << log[i] << "\n";
    EXPECT_NE(log[i].find("residual"), std::string::npos);
    residuals.push_back(result.iterations[i].residual);
  }
  residuals.push_back(result.residual);
  // The last iteration that began well above round-off squares the residual (in N), or does better: an inexact tangent
  // only takes a share off it.
  std::size_t k = residuals.size() - 1;
  while (k > 1 && residuals[k - 1] < 1e-5)
    --k;
  std::cout << "from " << residuals[k - 1] << " to " << residuals[k] << " N\n";
  EXPECT_LT(residuals[k - 1], 0.1);
  EXPECT_LT(residuals[k], residuals[k - 1] * residuals[k - 1]);
}

struct Reached
{
  Eigen::VectorXd solution;
  double pressure = 0; ///< MPa
  StepEffort effort;
  int n_in_contact = 0;
};

Reached reach(const dataset::Anatomy &anatomy, double displacement, const LoadStepperOptions &options)
{
  PelvisModel model = build_pelvis_model(anatomy, 1);
  LoadStepper stepper(model, options);
  Reached reached;
  stepper.start(anatomy.reference.target_displacement);
  reached.effort = stepper.advance_to(displacement);
  reached.solution = stepper.solution();
  reached.pressure = reached.solution[model.pressure_unknown];
  reached.n_in_contact = model.contact->n_in_contact(reached.solution);
  return reached;
}

// Chords and an early search of the pairs in contact are shorter ways to the same equilibrium. Pairs may differ where
// gaps do by less than ContactOptions::settled_gap: hence no closer.
TEST(PelvisNewton, ShorterWaysLeadToTheSameEquilibrium)
{
  const dataset::Anatomy anatomy = anatomy::build_anatomy(anatomy::case_text("quick"), "quick");
  const double displacement = 0.8 * anatomy.reference.target_displacement;
  LoadStepperOptions long_way;
  long_way.chord_increment = 0;
  long_way.search_increment = 0;
  const Reached by_long = reach(anatomy, displacement, long_way), by_short = reach(anatomy, displacement, {});
  std::cout << by_long.effort.factorisations << " and " << by_short.effort.factorisations << " factorisations, "
            << by_short.n_in_contact << " points in contact, solutions "
            << (by_long.solution - by_short.solution).cwiseAbs().maxCoeff() << " apart\n";
  ASSERT_GT(by_short.n_in_contact, 0);
  EXPECT_EQ(by_long.effort.factorisations, by_long.effort.newton_iterations);
  EXPECT_LT(by_short.effort.factorisations, by_long.effort.factorisations);
  EXPECT_LT(by_short.effort.factorisations, by_short.effort.newton_iterations);
  EXPECT_LT((by_long.solution - by_short.solution).cwiseAbs().maxCoeff(), 5e-4);
  EXPECT_NEAR(by_short.pressure, by_long.pressure, 1e-3 * by_long.pressure);
}

// The row of the pressure counts MPa as N, so 5e-7 MPa not yet applied is within the tolerance of 1e-6 N: taken for
// equilibrium, it kept the path at rest for ever.
TEST(PelvisNewton, LeavesRestFromAPressureBelowTheToleranceOfTheResidual)
{
  const dataset::Anatomy anatomy = anatomy::build_anatomy(anatomy::case_text("quick"), "quick");
  PelvisModel model = build_pelvis_model(anatomy, 1);
  LoadStepperOptions options;
  options.start_pressure = 5e-7;
  ASSERT_LT(options.start_pressure, options.residual_tolerance);
  int n_lines = 0;
  options.log = [&n_lines](const std::string &)
  {
    if (++n_lines > 200)
      throw std::runtime_error("the path does not leave rest");
  };
  const double target = anatomy.reference.target_displacement;
  LoadStepper stepper(model, options);
  const StepEffort effort = stepper.start(target);
  EXPECT_GE(stepper.displacement(), options.start_displacement * target);
  EXPECT_EQ(effort.cuts, 0);
}
} // namespace
} // namespace pelvireg::reference_fe
