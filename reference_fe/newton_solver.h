// Newton's method on an EquilibriumSystem at fixed loads.
#pragma once

#include "reference_fe/equilibrium_system.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
struct NewtonOptions
{
  double residual_tolerance = 1e-6; ///< N: converged when the largest scaled free residual is at most this
  /// Converged also when the last increment's largest entry is at most this (round-off floor of stiff thin shells).
  double increment_tolerance = 1e-13;
  int max_iterations = 25;
  /// A trial is accepted when its merit (2-norm of the scaled residual) is finite and at most this many times the
  /// merit before; else the step is halved. 1: monotone. Thin shells need freedom: a bending step stretches first.
  double max_merit_growth = 1e3;
  int max_halvings = 8;
  /// The step is shortened so that no unknown changes by more than this in one iteration; 0: no limit.
  double max_increment = 0;
  /// After a full step no longer than this its factors serve again while they contract (modified Newton): a chord costs
  /// a solve, a tangent its factorisation. 0: every iteration factorises.
  double chord_increment = 0;
  /// Called with the trial solution of a step no longer than revise_increment, before its residual is formed: here
  /// terms may change what they hold frozen (pairs in contact). True: they see something else, and no chord follows.
  std::function<bool(const Eigen::VectorXd &)> revise = {};
  double revise_increment = 0;
  /// One line an iteration; may be empty.
  std::function<void(const std::string &)> log = {};
};

enum class NewtonStatus
{
  converged,
  too_many_iterations,
  not_finite, ///< residual not finite at the start, or at every shortened step: inverted cell
  singular,   ///< the tangent could not be factorised
  no_decrease ///< line search exhausted
};

struct NewtonIteration
{
  double residual = 0;     ///< N, largest scaled free residual before the step
  double increment = 0;    ///< largest change of an unknown in the step
  double step_length = 1;  ///< of the line search
  bool is_chord = false;   ///< with the factors of an earlier iteration
  bool is_revised = false; ///< NewtonOptions::revise changed the terms at its end
};

struct NewtonResult
{
  NewtonStatus status = NewtonStatus::too_many_iterations;
  double residual = 0; ///< N, at the returned solution
  std::vector<NewtonIteration> iterations;
  std::string message; ///< one sentence when not converged: why, residual, worst row

  bool converged() const { return status == NewtonStatus::converged; }
};

/// Solve R(solution) = 0 in place. When the result is not converged, `solution` holds the last accepted iterate: the
/// caller keeps its own copy to go back to. Terms' end_step() is left to the caller.
NewtonResult solve_newton(EquilibriumSystem &system, Eigen::VectorXd &solution, const NewtonOptions &options);
} // namespace pelvireg::reference_fe
