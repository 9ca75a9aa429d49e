#include "reference_fe/reference.h"

#include "reference_fe/load_stepper.h"
#include "reference_fe/model_checks.h"
#include "reference_fe/pelvis_model.h"
#include "reference_fe/truth_recorder.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
constexpr double largest_energy_error = 1; // percent of the external work
constexpr double largest_penetration = 0.1; // mm

/// Where the deepest penetration is, when it is too deep.
std::string place(const ContactPenetration &deepest)
{
  const Eigen::Vector3d &x = deepest.position;
  return deepest.depth <= largest_penetration ? ""
                                              : fmt::format(" ({} into {} at {:.1f}, {:.1f}, {:.1f})", deepest.part,
                                                            deepest.other, x.x(), x.y(), x.z());
}

std::string describe(int increment, int n_increments, const dataset::IncrementRecord &record,
                     const dataset::BalanceRecord &balance, const ContactPenetration &deepest, int unsettled_steps)
{
  const bool is_balanced = std::abs(balance.energy_error_percent) <= largest_energy_error;
  return fmt::format("increment {} of {}: vagina {:.2f} mm, pressure {:.2f} kPa, {} iterations, {} cuts, penetration "
                     "{:.3f} mm{}{}{}",
                     increment, n_increments, record.mean_vaginal_displacement, 1e3 * record.pressure,
                     record.newton_iterations, record.cuts, record.max_penetration, place(deepest),
                     unsettled_steps > 0 ? fmt::format(", contact unsettled in {} steps", unsettled_steps) : "",
                     is_balanced ? "" : fmt::format(", energy balance off by {:.2f} %", balance.energy_error_percent));
}
} // namespace

dataset::Truth solve_reference(const dataset::Anatomy &anatomy, const ReferenceOptions &options)
{
  check_model(anatomy.reference);
  PelvisModel model = build_pelvis_model(anatomy, options.n_threads);
  TruthRecorder recorder(model, anatomy.case_name);
  const auto report = [&](double done, const std::string &line)
  {
    if (options.progress)
      options.progress(done, line);
  };
  report(0, fmt::format("{} unknowns", model.system.n_free()));

  LoadStepperOptions stepping;
  stepping.log = options.log;
  stepping.increment = anatomy.reference.target_displacement / anatomy.reference.n_increments;
  LoadStepper stepper(model, stepping);
  StepEffort settling = stepper.start(anatomy.reference.target_displacement);
  const int n = anatomy.reference.n_increments;
  for (int increment = 1; increment <= n; ++increment)
  {
    StepEffort effort;
    try
    {
      effort = stepper.advance_to(anatomy.reference.target_displacement * increment / n);
      effort.newton_iterations += std::exchange(settling.newton_iterations, 0);
      effort.cuts += std::exchange(settling.cuts, 0);
      effort.unsettled_steps += std::exchange(settling.unsettled_steps, 0);
      recorder.record(stepper.solution(), effort, stepper.work());
    }
    catch (const ComputationError &error)
    {
      throw ComputationError(fmt::format("increment {} of {}: {}", increment, n, error.what()));
    }
    const ContactPenetration deepest =
        model.contact ? model.contact->deepest_penetration(stepper.solution()) : ContactPenetration{};
    report(static_cast<double>(increment) / n,
           describe(increment, n, recorder.truth().increments.back(), recorder.truth().balances.back(), deepest,
                    effort.unsettled_steps));
  }
  return recorder.truth();
}
} // namespace pelvireg::reference_fe
