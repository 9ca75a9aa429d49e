#include "reference_fe/newton_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
/// Try solution + step_length * increment, halving. Leaves the system assembled with tangent at the accepted point.
NewtonStatus take_step(EquilibriumSystem &system, Eigen::VectorXd &solution, const Eigen::VectorXd &increment,
                       const NewtonOptions &options, double &step_length)
{
  const double merit_before = system.residual_merit();
  system.linearise_at(solution);
  for (int halving = 0; halving <= options.max_halvings; ++halving, step_length *= 0.5)
  {
    const Eigen::VectorXd trial = solution + step_length * increment;
    // The full step is nearly always accepted: its tangent is wanted next.
    system.assemble(trial, halving == 0);
    const double merit = system.residual_merit();
    if (std::isfinite(merit) && merit <= options.max_merit_growth * merit_before)
    {
      if (halving > 0)
        system.assemble(trial, true);
      solution = trial;
      return NewtonStatus::converged;
    }
  }
  const bool finite = std::isfinite(system.residual_merit());
  return finite ? NewtonStatus::no_decrease : NewtonStatus::not_finite;
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
    if (!system.factorise())
      return finish(NewtonStatus::singular);

    const Eigen::VectorXd increment = system.solve(-system.residual());
    const double largest = increment.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(largest))
      return finish(NewtonStatus::singular);
    double step_length = 1;
    if (options.max_increment > 0 && largest > options.max_increment)
      step_length = options.max_increment / largest;
    const NewtonStatus step = take_step(system, solution, increment, options, step_length);
    result.iterations.push_back({residual, step_length * largest, step_length});
    if (options.log)
      options.log(fmt::format("    iteration {:2d}: residual {:.3e} N, increment {:.3e}, step length {:.3g}",
                              result.iterations.size(), residual, step_length * largest, step_length));
    if (step != NewtonStatus::converged)
      return finish(step);
  }
}
} // namespace pelvireg::reference_fe
