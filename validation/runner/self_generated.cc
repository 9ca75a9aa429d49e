#include "validation/runner/self_generated.h"

#include "synthetic/dataset/error.h"
#include "validation/runner/truth_organ.h"

#include <fmt/format.h>

#include <algorithm>

namespace pelvireg::runner
{
namespace
{
const dataset::EstimateSample &nominal_run(const dataset::Estimate &estimate, const std::string &driver)
{
  const auto nominal = std::find_if(estimate.samples.begin(), estimate.samples.end(),
                                    [](const dataset::EstimateSample &sample) { return sample.sample == 0; });
  if (nominal == estimate.samples.end())
    throw InputError(fmt::format("the estimate of '{}' has no sample 0, whose motion is to be the truth; register it "
                                 "again",
                                 driver));
  for (std::size_t step = 0; step < nominal->steps.size(); ++step)
    if (nominal->steps[step].status != "ok")
      throw InputError(
          fmt::format("step {} of the registration of '{}' is '{}', but every step must be ok for a truth; "
                      "use another driving case",
                      step + 1, driver, nominal->steps[step].status));
  return *nominal;
}
} // namespace

dataset::Truth self_generated_truth(const dataset::Anatomy &anatomy, const dataset::Estimate &estimate,
                                    const std::string &driver)
{
  const dataset::EstimateSample &run = nominal_run(estimate, driver);
  const auto n_increments = static_cast<std::size_t>(anatomy.reference.n_increments);
  const auto per_increment = static_cast<std::size_t>(anatomy.registration_steps_per_increment);
  if (run.steps.size() != n_increments * per_increment)
    throw InputError(fmt::format("the registration of '{}' has {} steps, must have {} increments of {}; use a driving "
                                 "case with the same number of increments",
                                 driver, run.steps.size(), n_increments, per_increment));
  dataset::Truth truth;
  truth.case_name = anatomy.case_name;
  truth.source = fmt::format("{} (full, nominal run) on the outlines of {}", dataset::truth_of_registration, driver);
  truth.increments.resize(n_increments);
  for (const dataset::EstimateSurface &surface : run.surfaces)
  {
    dataset::TruthSurface moved{.name = surface.name, .rest = surface.rest, .displacements = {}};
    for (std::size_t k = 1; k <= n_increments; ++k)
    {
      moved.displacements.push_back(surface.positions[k * per_increment - 1] - surface.rest.points);
      if (surface.name == "vagina")
        truth.increments[k - 1].mean_vaginal_displacement = mean_in_plane_displacement(moved, anatomy.dyn_plane);
    }
    truth.surfaces.push_back(std::move(moved));
  }
  return truth;
}
} // namespace pelvireg::runner
