#include "reference_fe/load_stepper.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
std::string likely_cause(NewtonStatus status)
{
  switch (status)
  {
  case NewtonStatus::singular:
    return "a part that nothing holds";
  case NewtonStatus::not_finite:
    return "a cell that turned inside out";
  default:
    return "a wall or bar that snaps, or contact that does not settle";
  }
}
} // namespace

LoadStepper::LoadStepper(PelvisModel &model, const LoadStepperOptions &options)
    : model_(model), options_(options), step_(options.first_step)
{
  current_.solution = Eigen::VectorXd::Zero(model.system.n_unknowns());
  previous_ = current_;
}

void LoadStepper::start()
{
  StepEffort effort;
  Eigen::VectorXd trial = current_.solution;
  model_.probe->prescribe_pressure(options_.start_pressure);
  if (!solve(trial, effort))
    throw ComputationError(fmt::format("the reference did not converge under the first pressure of {} MPa: {}",
                                       options_.start_pressure, last_result_.message));
  accept(std::move(trial));
}

StepEffort LoadStepper::advance_to(double target)
{
  StepEffort effort;
  while (current_.displacement < target)
  {
    // A last sub-step that would leave a sliver is taken whole.
    const double left = target - current_.displacement;
    const double next = left <= 1.1 * step_ ? target : current_.displacement + step_;
    Eigen::VectorXd trial = predict(next);
    model_.probe->prescribe_displacement(next);
    const int iterations_before = effort.newton_iterations;
    if (solve(trial, effort))
    {
      accept(std::move(trial));
      if (effort.newton_iterations - iterations_before <= 12)
        step_ *= 1.5;
      if (next == target)
        break;
      continue;
    }
    model_.system.end_step(false);
    ++effort.cuts;
    step_ = 0.4 * std::min(step_, left);
    if (step_ < options_.least_step)
      throw ComputationError(fmt::format(
          "the reference did not converge at a mean vaginal displacement of {:.3f} mm with steps down to {:.4f} mm: {} "
          "(likely cause: {})",
          next, options_.least_step, last_result_.message, likely_cause(last_result_.status)));
  }
  return effort;
}

bool LoadStepper::solve(Eigen::VectorXd &trial, StepEffort &effort)
{
  NewtonOptions newton;
  newton.residual_tolerance = options_.residual_tolerance;
  newton.max_iterations = options_.max_iterations;
  newton.log = options_.log;
  if (model_.contact)
    model_.contact->search(current_.solution);
  for (int search = 0;; ++search)
  {
    last_result_ = solve_newton(model_.system, trial, newton);
    effort.newton_iterations += static_cast<int>(last_result_.iterations.size());
    effort.residual = last_result_.residual;
    if (options_.log)
      options_.log(fmt::format("  displacement {:.4f} mm, pressure {:.6f} MPa, {} iterations, residual {:.2e} N {}",
                               model_.probe->mean_displacement(trial), trial[model_.pressure_unknown],
                               last_result_.iterations.size(), last_result_.residual, last_result_.message));
    if (!last_result_.converged())
      return false;
    if (!model_.contact || search == options_.max_contact_searches || !model_.contact->search(trial))
      return true;
  }
}

void LoadStepper::accept(Eigen::VectorXd trial)
{
  model_.system.end_step(true);
  previous_ = std::move(current_);
  current_.displacement = model_.probe->mean_displacement(trial);
  current_.solution = std::move(trial);
}

Eigen::VectorXd LoadStepper::predict(double target) const
{
  const double ratio = (target - current_.displacement) / (current_.displacement - previous_.displacement);
  return current_.solution + ratio * (current_.solution - previous_.solution);
}
} // namespace pelvireg::reference_fe
