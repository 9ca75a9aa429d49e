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
