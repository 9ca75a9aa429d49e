#include "reference_fe/newton_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
/// A chord is this much shorter than the step before, or it is not taken: where the factors of an earlier tangent
/// still contract (Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 2.1), they do so at once.
constexpr double chord_contraction = 0.1;

double largest(const Eigen::VectorXd &increment)
{
  return increment.lpNorm<Eigen::Infinity>();
}

/// Try solution + step_length * increment, halving. Leaves the system assembled at the accepted point, with the tangent
/// when that is wanted.
NewtonStatus take_step(EquilibriumSystem &system, Eigen::VectorXd &solution, const Eigen::VectorXd &increment,
                       bool with_tangent, const NewtonOptions &options, double &step_length)
{
  const double merit_before = system.residual_merit();
  system.linearise_at(solution);
  for (int halving = 0; halving <= options.max_halvings; ++halving, step_length *= 0.5)
  {
    const Eigen::VectorXd trial = solution + step_length * increment;
    // The full step is nearly always accepted: its tangent comes at once.
    system.assemble(trial, with_tangent && halving == 0);
    const double merit = system.residual_merit();
    if (std::isfinite(merit) && merit <= options.max_merit_growth * merit_before)
    {
      if (with_tangent && halving > 0)
        system.assemble(trial, true);
      solution = trial;
      return NewtonStatus::converged;
    }
  }
  const bool finite = std::isfinite(system.residual_merit());
  return finite ? NewtonStatus::no_decrease : NewtonStatus::not_finite;
}

/// Whether the factors of the last step may serve for the next.
bool is_close(const std::vector<NewtonIteration> &iterations, double chord_increment)
{
  if (iterations.empty())
    return false;
  const NewtonIteration &last = iterations.back();
  return last.step_length == 1 && last.increment <= chord_increment && !last.is_revised;
}

std::string describe(const std::vector<NewtonIteration> &iterations)
{
  const NewtonIteration &last = iterations.back();
  return fmt::format("    iteration {:2d}: residual {:.3e} N, increment {:.3e}, step length {:.3g}{}{}",
                     iterations.size(), last.residual, last.increment, last.step_length,
                     last.is_chord ? ", earlier factors" : "", last.is_revised ? ", other pairs in contact" : "");
}

std::string explain(NewtonStatus status, const EquilibriumSystem &system, double residual)
{
  const std::string where = fmt::format("largest residual {:.3e} N at {}", residual, system.worst_row());
  switch (status)
  {
  case NewtonStatus::converged:
    return "";
  case NewtonStatus::too_many_iterations:
    return "the iterations ran out: " + where;
  case NewtonStatus::not_finite:
    return "the residual is not finite, likely an inverted cell: " + where;
  case NewtonStatus::singular:
    return "the tangent is singular, likely a limit point or an unconstrained part: " + where;
  case NewtonStatus::no_decrease:
    return "no shortened step lowers the residual: " + where;
  }
  return "";
}

struct Increment
{
  Eigen::VectorXd value;
  bool is_chord = false;
};

/// The step from `solution`, at which the system is assembled, with its tangent or not: by the factors of the last
/// iteration where they serve, else by new ones. Nothing when the tangent is singular.
std::optional<Increment> next_increment(EquilibriumSystem &system, const Eigen::VectorXd &solution, bool has_tangent,
                                        const std::vector<NewtonIteration> &iterations, double chord_increment)
{
  if (is_close(iterations, chord_increment))
  {
    Eigen::VectorXd chord = system.solve(-system.residual());
    if (largest(chord) <= chord_contraction * iterations.back().increment)
      return Increment{std::move(chord), true};
  }
  if (!has_tangent)
    system.assemble(solution, true);
  if (!system.factorise())
    return std::nullopt;
  Eigen::VectorXd increment = system.solve(-system.residual());
  if (!std::isfinite(largest(increment)))
    return std::nullopt;
  return Increment{std::move(increment), false};
}
} // namespace

NewtonResult solve_newton(EquilibriumSystem &system, Eigen::VectorXd &solution, const NewtonOptions &options)
{
  NewtonResult result;
  const auto finish = [&](NewtonStatus status)
  {
    result.status = status;
    result.residual = system.residual_norm();
    result.message = explain(status, system, result.residual);
    return result;
  };

  system.linearise_at(solution);
  system.assemble(solution, true);
  bool has_tangent = true;
  while (true)
  {
    const double residual = system.residual_norm();
    if (!std::isfinite(residual))
      return finish(NewtonStatus::not_finite);
    const bool stalled = !result.iterations.empty() && result.iterations.back().step_length == 1 &&
                         result.iterations.back().increment <= options.increment_tolerance;
    if (residual <= options.residual_tolerance || stalled)
      return finish(NewtonStatus::converged);
    if (static_cast<int>(result.iterations.size()) >= options.max_iterations)
      return finish(NewtonStatus::too_many_iterations);

    const std::optional<Increment> increment =
        next_increment(system, solution, has_tangent, result.iterations, options.chord_increment);
    if (!increment)
      return finish(NewtonStatus::singular);
    const double full_length = largest(increment->value);
    NewtonIteration now{.residual = residual, .is_chord = increment->is_chord};
    if (options.max_increment > 0 && full_length > options.max_increment)
      now.step_length = options.max_increment / full_length;
    const double length = now.step_length * full_length;
    now.is_revised = options.revise && length <= options.revise_increment &&
                     options.revise(solution + now.step_length * increment->value);
    // What comes after a short step is a chord or the end, likely.
    has_tangent = length > options.chord_increment || now.is_revised;
    const NewtonStatus step = take_step(system, solution, increment->value, has_tangent, options, now.step_length);
    now.increment = now.step_length * full_length;
    result.iterations.push_back(now);
    if (options.log)
      options.log(describe(result.iterations));
    if (step != NewtonStatus::converged)
      return finish(step);
  }
}
} // namespace pelvireg::reference_fe
