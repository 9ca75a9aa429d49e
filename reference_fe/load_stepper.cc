#include "reference_fe/load_stepper.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double unlimited = std::numeric_limits<double>::infinity();

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
int n_factorisations(const NewtonResult &result)
{
  return static_cast<int>(std::count_if(result.iterations.begin(), result.iterations.end(),
                                        [](const NewtonIteration &iteration) { return !iteration.is_chord; }));
}
} // namespace

LoadStepper::LoadStepper(PelvisModel &model, const LoadStepperOptions &options)
    : model_(model), options_(options), motion_(options.first_motion), work_(model.load, model.cavities)
{
  current_.solution = Eigen::VectorXd::Zero(model.system.n_unknowns());
  previous_ = current_;
  work_.advance(current_.solution);
}

StepEffort LoadStepper::start(double target)
{
  StepEffort effort;
  while (!try_pressure(0, options_.start_pressure * motion_ / options_.first_motion, effort))
    cut(effort);
  while (current_.displacement < options_.start_displacement * target)
  {
    const double motion = motion_between(previous_.solution, current_.solution);
    const double displacement = current_.displacement - previous_.displacement;
    // Not past the first displacement wanted, nor more than a fivefold pressure at once.
    const double ratio = std::min({motion_ / motion, 4., 2 * options_.start_displacement * target / displacement});
    if (!try_pressure(ratio, current_.pressure + ratio * (current_.pressure - previous_.pressure), effort))
      cut(effort);
  }
  return effort;
}

StepEffort LoadStepper::advance_to(double target)
{
  StepEffort effort;
  while (current_.displacement < target)
  {
    const double last = current_.displacement - previous_.displacement;
    const double possible = motion_ / motion_between(previous_.solution, current_.solution);
    const double left = last > 0 ? (target - current_.displacement) / last : unlimited;
    // The last step of an increment lands on the displacement; the others go along the path, folds included.
    const bool lands = left <= 1.1 * possible;
    const double ratio = lands || left > 10 * possible ? std::min(left, possible) : left / std::ceil(left / possible);
    control_step(lands, target, ratio);
    if (!try_step(predicted(ratio), lands ? unlimited : target, effort))
      cut(effort);
    else if (lands)
      break;
  }
  return effort;
}

void LoadStepper::control_step(bool lands, double target, double ratio)
{
  begin_step(lands ? target : current_.displacement + ratio * (current_.displacement - previous_.displacement));
  if (lands)
  {
    model_.path->release();
    model_.probe->prescribe_displacement(target);
    return;
  }
  model_.probe->release();
  model_.path->prescribe(current_.solution, predicted(ratio));
}

void LoadStepper::begin_step(double displacement)
{
  step_end_ = std::max(current_.load_parameter, displacement / options_.increment);
  for (const std::shared_ptr<Cavity> &cavity : model_.cavities)
    cavity->begin_step(step_end_);
}

Eigen::VectorXd LoadStepper::predicted(double ratio) const
{
  return current_.solution + ratio * (current_.solution - previous_.solution);
}

bool LoadStepper::try_pressure(double ratio, double pressure, StepEffort &effort)
{
  model_.probe->prescribe_pressure(pressure);
  Eigen::VectorXd trial = predicted(ratio);
  trial[model_.pressure_unknown] = pressure;
  return try_step(std::move(trial), unlimited, effort);
}

bool LoadStepper::try_step(Eigen::VectorXd trial, double largest_displacement, StepEffort &effort)
{
  const StepEffort before = effort;
  const bool is_solved = solve(trial, effort);
  const double motion = motion_between(current_.solution, trial);
  if (options_.log)
    options_.log(fmt::format(
        "  {} displacement {:.4f} mm, pressure {:.6f} MPa, motion {:.3f} mm, {} iterations, "
        "residual {:.1e} N {}",
        is_solved ? "step to" : "failed at", model_.probe->mean_displacement(trial), trial[model_.pressure_unknown],
        motion, effort.newton_iterations - before.newton_iterations, last_result_.residual, last_result_.message));
  if (!is_solved || !(motion <= options_.largest_motion) ||
      model_.probe->mean_displacement(trial) > largest_displacement)
    return false;
  accept(std::move(trial));
  const bool is_start_over = current_.load_parameter > 0;
  const bool is_as_long_as_aimed =
      motion >= (is_start_over ? options_.reached_motion : options_.settled_motion) * motion_;
  if (is_as_long_as_aimed && effort.factorisations - before.factorisations <= options_.easy_factorisations)
    motion_ = std::min(1.15 * motion_, options_.motion);
  return true;
}

void LoadStepper::cut(StepEffort &effort)
{
  model_.system.end_step(false);
  ++effort.cuts;
  motion_ *= 0.4;
  if (motion_ < options_.least_motion)
    throw ComputationError(
        fmt::format("the reference did not converge beyond a mean vaginal displacement of {:.3f} mm with steps down to "
                    "{} mm of motion: residual {:.2e} N, {} (likely cause: {})",
                    current_.displacement, options_.least_motion, last_result_.residual, last_result_.message,
                    likely_cause(last_result_.status)));
}

bool LoadStepper::solve(Eigen::VectorXd &trial, StepEffort &effort)
{
  if (model_.contact)
    model_.contact->search(current_.solution);
  for (int search = 0;; ++search)
  {
    solve_equilibrium(trial, effort);
    if (!last_result_.converged())
      return false;
    if (!model_.contact || !model_.contact->search(trial))
      return true;
    if (search == options_.max_contact_searches)
    {
      ++effort.unsettled_steps;
      return true;
    }
  }
}

void LoadStepper::solve_equilibrium(Eigen::VectorXd &trial, StepEffort &effort)
{
  const Eigen::VectorXd predicted = trial;
  NewtonOptions newton;
  newton.residual_tolerance = options_.residual_tolerance;
  newton.max_iterations = options_.max_iterations;
  newton.max_halvings = options_.max_halvings;
  newton.chord_increment = options_.chord_increment;
  newton.revise_increment = options_.search_increment;
  // What differs by less than search() tells would go to and fro for ever: the first search without a change is the
  // last.
  int searches_left = model_.contact ? options_.max_contact_searches : 0;
  newton.revise = [&](const Eigen::VectorXd &x)
  {
    const bool has_changed = searches_left > 0 && model_.contact->search(x);
    searches_left = has_changed ? searches_left - 1 : 0;
    return has_changed;
  };
  newton.log = options_.log;
  for (const bool mixed : {true, false})
  {
    for (const std::shared_ptr<ShellTerm> &shell : model_.shells)
      shell->use_mixed_integration_points(mixed);
    last_result_ = solve_newton(model_.system, trial, newton);
    effort.newton_iterations += static_cast<int>(last_result_.iterations.size());
    effort.factorisations += n_factorisations(last_result_);
    effort.residual = last_result_.residual;
    if (last_result_.converged())
      return;
    // What is close already is worth going on from.
    if (!(last_result_.residual < options_.close_residual))
      trial = predicted;
  }
}

void LoadStepper::accept(Eigen::VectorXd trial)
{
  model_.system.end_step(true);
  previous_ = std::move(current_);
  current_.displacement = model_.probe->mean_displacement(trial);
  current_.pressure = trial[model_.pressure_unknown];
  for (const std::shared_ptr<Cavity> &cavity : model_.cavities)
    cavity->accept_step(trial);
  current_.load_parameter = step_end_;
  current_.solution = std::move(trial);
  work_.advance(current_.solution);
}

double LoadStepper::motion_between(const Eigen::VectorXd &from, const Eigen::VectorXd &to) const
{
  double largest = 0;
  for (const OuterSurface &surface : model_.surfaces)
    for (const SurfaceNode &vertex : surface.vertices)
      largest = std::max(largest, (vertex.position(to) - vertex.position(from)).norm());
  return largest;
}
} // namespace pelvireg::reference_fe
