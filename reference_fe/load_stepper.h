// The quasi-static loop: how the pelvis is moved from increment to increment.
#pragma once

#include "reference_fe/newton_solver.h"
#include "reference_fe/pelvis_model.h"

#include <functional>
#include <string>

namespace pelvireg::reference_fe
{
struct LoadStepperOptions
{
  double residual_tolerance = 1e-6;                  ///< N, largest scaled free residual of a converged state
  double start_pressure = 5e-5;                      ///< MPa, prescribed before the displacement takes over
  double first_step = 0.2;                           ///< mm, first displacement step
  double least_step = 0.005;                         ///< mm, below it the stepper gives up
  int max_iterations = 15;                           ///< of Newton's method, a solution
  int max_contact_searches = 6;                      ///< repetitions of a step until the pairs in contact settle
  std::function<void(const std::string &)> log = {}; ///< one line a step; may be empty
};

/// What it took to reach a target.
struct StepEffort
{
  double residual = 0; ///< N, of the accepted state
  int newton_iterations = 0;
  int cuts = 0;
};

/// Displacement control with an unknown load factor: each step prescribes the mean vaginal in-plane displacement and
/// finds positions, cavity pressures and the abdominal pressure together.
class LoadStepper
{
public:
  LoadStepper(PelvisModel &model, const LoadStepperOptions &options);

  /// Leave the rest state under a small prescribed pressure: the displacement has no derivative at rest.
  /// Throws ComputationError when that fails.
  void start();
  /// Move on to a mean displacement (mm), in sub-steps where needed. Throws ComputationError with displacement,
  /// residual and likely cause when the least step does not converge.
  StepEffort advance_to(double target);

  const Eigen::VectorXd &solution() const { return current_.solution; }
  double displacement() const { return current_.displacement; } ///< mm

private:
  struct State
  {
    Eigen::VectorXd solution;
    double displacement = 0; ///< mm
  };
  /// Equilibrium with settled contact pairs, from `trial`; false when Newton's method fails.
  bool solve(Eigen::VectorXd &trial, StepEffort &effort);
  void accept(Eigen::VectorXd trial);
  Eigen::VectorXd predict(double target) const;

  PelvisModel &model_;
  LoadStepperOptions options_;
  State previous_, current_;
  double step_;              ///< mm, what the last step has shown to be possible
  NewtonResult last_result_; ///< of the last solution, for the message when it failed
};
} // namespace pelvireg::reference_fe
