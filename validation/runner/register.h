// Play the outlines of one image plane to the system under test and keep where it puts the organs.
#pragma once

#include "registration/registration.h"
#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/estimate_file.h"
#include "synthetic/dataset/observations.h"
#include "validation/runner/conditions.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::registration
{
struct Mutation;
}

namespace pelvireg::runner
{
/// One of n equal shares of the runs, so that several processes or machines can share them.
struct Shard
{
  int index = 1; ///< 1 … n
  int n = 1;
};

/// The runs of a shard, ascending: those of 0 … samples whose number mod n is index - 1.
std::vector<int> runs_of_shard(int samples, const Shard &shard);

struct RunnerOptions
{
  int samples = 0; ///< randomised runs beside the nominal one, which is sample 0; >= 0
  dataset::Perturbation perturbation{.modulus_spread = 0.10}; ///< of the randomised runs (paper, section 6.1)
  int n_threads = 1; ///< runs side by side, >= 1; the result is bit-identical for every value
  /// For tests of the regression gate alone (registration/mutation.h): a fault to be built into the registration.
  const registration::Mutation *mutation = nullptr;
  /// Called as the runs go on, never from two threads at once: fraction done (0 … 1) and one line of what happened.
  std::function<void(double, const std::string &)> progress;
};

/// Mean wall time of one of registration::step_phases.
struct PhaseTiming
{
  std::string name;
  double mean_ms = 0;
};

/// Title of the phase of this name; the name itself when it is not one of registration::step_phases.
std::string phase_title(const std::string &phase);

/// How long the steps of the nominal run took on this machine; not part of the estimate, which is the same on every
/// run.
struct StepTiming
{
  std::string condition; ///< label of the estimate
  int n_steps = 0;
  double median_ms = 0, p95_ms = 0, max_ms = 0;
  double mean_ms = 0;                   ///< the phases' means add up to it, but for what lies between them
  std::vector<PhaseTiming> phases = {}; ///< in the order of a step; empty when they were not recorded
};

/// `times` of at least one step.
StepTiming timing_of(const std::string &label, const dataset::StepTimes &times);

/// The runs of one condition. Each depends on its number alone, so they can be played in any order, anywhere.
///
/// In a run every one of the observed increments is played registration_steps_per_increment times (paper, section 6.2:
/// 15 positions, 3 steps each). The organs' positions after each step and what the step says of itself are kept; a step
/// that fails is recorded with its status and the last valid positions, never dropped.
class RegistrationRuns
{
public:
  /// Throws InputError for an unknown condition, a perturbation out of range, observations of another case or plane, a
  /// missing organ.
  RegistrationRuns(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                   const std::string &condition, const dataset::Perturbation &perturbation);

  /// For tests of the regression gate alone (registration/mutation.h): build a fault into every run.
  void mutate(const registration::Mutation &mutation);

  /// The estimate without its samples.
  const dataset::Estimate &description() const { return description_; }
  /// Of the nominal run, without positions.
  const std::vector<dataset::EstimateSurface> &rest_surfaces() const { return rest_surfaces_; }
  int n_steps() const { return static_cast<int>(observations_.frames.size()) * steps_per_increment_; }

  /// Play run `sample`, 0 the nominal one. From several threads at once if need be. `times` receives the wall time of
  /// each step, step_done is called after each. Throws InputError for a model that the registration refuses.
  dataset::EstimateSample play(int sample, dataset::StepTimes &times, const std::function<void()> &step_done) const;

private:
  dataset::RegistrationModel model_of_run(int sample) const;

  std::string condition_;
  dataset::RegistrationModel model_; ///< nominal, with everything that the condition takes away
  dataset::Observations observations_;
  registration::Options options_;
  int steps_per_increment_ = 0;
  dataset::Estimate description_;
  std::vector<dataset::EstimateSurface> rest_surfaces_;
};

/// A run that has ended, with the wall time of its steps.
using RunDone = std::function<void(const dataset::EstimateSample &, const dataset::StepTimes &)>;

/// Play the runs `numbers` on options.n_threads threads. `done` receives each when it ends, never two at once, in any
/// order. When a run fails no further one is begun.
void play_runs(const RegistrationRuns &runs, const std::vector<int> &numbers, const RunnerOptions &options,
               const RunDone &done);

/// All runs of one condition, in memory. Throws InputError for options out of range and as RegistrationRuns does.
/// `timing`, when given, receives the nominal run's step times.
dataset::Estimate run_registration(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                                   const std::string &condition, const RunnerOptions &options,
                                   StepTiming *timing = nullptr);
} // namespace pelvireg::runner
