// Play the outlines of one image plane to the system under test and keep where it puts the organs.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pelvireg::registration
{
struct Mutation;
}

namespace pelvireg::runner
{
struct RunnerOptions
{
  int samples = 0;      ///< randomised runs beside the nominal one, which is sample 0; >= 0
  double spread = 0.10; ///< Young's moduli are multiplied by 1 + spread U(-1, 1); 0 <= spread < 1 (paper, section 6.1)
  std::uint64_t seed = 1; ///< of the randomised runs
  int n_threads = 1;      ///< runs side by side, >= 1; the result is bit-identical for every value
  /// For tests of the regression gate alone (registration/mutation.h): a fault to be built into the registration.
  const registration::Mutation *mutation = nullptr;
  /// Called as the runs go on, never from two threads at once: fraction done (0 … 1) and one line of what happened.
  std::function<void(double, const std::string &)> progress;
};

/// How long the steps of the nominal run took on this machine; not part of the estimate, which is the same on every
/// run.
struct StepTiming
{
  std::string condition;
  int n_steps = 0;
  double median_ms = 0, p95_ms = 0, max_ms = 0;
};

/// The conditions that run_registration knows: "full", "no_boundary_conditions" (image constraints alone), and
/// ablations of full: "no_contact", "no_friction" (organs in contact slide freely).
std::vector<std::string> condition_names();

/// Those that are run when nobody asks for others: the two of the paper.
std::vector<std::string> default_conditions();

/// Register one condition: every one of the observed increments is played registration_steps_per_increment times
/// (paper, section 6.2: 15 positions, 3 steps each). The organs' positions after each step and what the step says of
/// itself are kept; a step that fails is recorded with its status and the last valid positions, never dropped. Throws
/// InputError for an unknown condition, options out of range, observations of another case or plane, a missing organ,
/// and for a model that the registration refuses. `timing`, when given, receives the nominal run's step times.
dataset::Estimate run_registration(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                                   const std::string &condition, const RunnerOptions &options,
                                   StepTiming *timing = nullptr);
} // namespace pelvireg::runner
