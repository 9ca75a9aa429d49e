// The one public entry of the reference solver.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"

#include <functional>
#include <string>

namespace pelvireg::reference_fe
{
struct ReferenceOptions
{
  int n_threads = 1; ///< assembly threads; the result is bit-identical for every value
  /// Called as the solve goes on: fraction done (0 … 1) and one line of what happened.
  std::function<void(double, const std::string &)> progress;
  /// One line a step of the load stepper and an iteration of Newton's method, for those who look for the cause of a
  /// failure; may be empty.
  std::function<void(const std::string &)> log = {};
};

/// Move the pelvis: follower pressure on the peritoneal surfaces, the load factor an unknown, increment k ends where
/// the mean vaginal in-plane displacement is k/n of the target (DESIGN 5.1). Quasi-static, every increment converged.
/// Throws InputError for a model that cannot be solved (unknown material, unconstrained part, inverted cell, …) and
/// ComputationError with increment, residual and likely cause when an increment does not converge at the least step.
dataset::Truth solve_reference(const dataset::Anatomy &anatomy, const ReferenceOptions &options);
} // namespace pelvireg::reference_fe
