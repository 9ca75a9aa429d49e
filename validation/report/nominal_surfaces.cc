#include "validation/report/nominal_surfaces.h"

#include "validation/runner/evaluate_checks.h"
#include "validation/runner/outer_surface.h"

#include <cstddef>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

ConditionSurfaces unmoved(const dataset::Anatomy &anatomy)
{
  ConditionSurfaces surfaces{runner::unregistered, "", {}};
  for (const std::string &organ : organ_names)
  {
    const auto body = static_cast<std::size_t>(runner::body_index(anatomy.registration, organ));
    const dataset::SurfaceMesh rest = runner::outer_surface(anatomy.registration.bodies[body]).rest;
    surfaces.organs.push_back({rest, {rest.points}});
  }
  return surfaces;
}

/// The nominal run is the same whatever the randomised ones were given: one estimate of a condition shows it.
bool shows_nominal_run(const dataset::Estimate &estimate, const std::vector<dataset::Estimate> &estimates)
{
  return std::none_of(estimates.begin(), estimates.end(),
                      [&](const dataset::Estimate &other)
                      { return other.condition == estimate.condition && other.label() < estimate.label(); });
}

ConditionSurfaces moved(const dataset::Estimate &estimate, const dataset::EstimateSample &run)
{
  ConditionSurfaces surfaces{estimate.label(), estimate.condition, {}};
  for (const dataset::EstimateSurface &surface : run.surfaces)
  {
    MovingSurface organ{surface.rest, {surface.rest.points}};
    organ.frames.insert(organ.frames.end(), surface.positions.begin(), surface.positions.end());
    surfaces.organs.push_back(std::move(organ));
  }
  return surfaces;
}
} // namespace

std::vector<MovingSurface> truth_surfaces(const dataset::Truth &truth)
{
  std::vector<MovingSurface> organs;
  for (const std::string &name : organ_names)
  {
    const dataset::TruthSurface &surface = runner::truth_surface(truth, name);
    MovingSurface organ{surface.rest, {surface.rest.points}};
    for (const dataset::Points &displacement : surface.displacements)
      organ.frames.emplace_back(surface.rest.points + displacement);
    organs.push_back(std::move(organ));
  }
  return organs;
}

std::vector<ConditionSurfaces> nominal_surfaces(const ReportInputs &inputs)
{
  std::vector<ConditionSurfaces> conditions;
  for (const std::string &condition : inputs.evaluation.conditions)
  {
    if (condition == runner::unregistered)
      conditions.push_back(unmoved(inputs.anatomy));
    for (const dataset::Estimate &estimate : inputs.estimates)
      for (const dataset::EstimateSample &run : estimate.samples)
        if (estimate.label() == condition && run.sample == 0 && shows_nominal_run(estimate, inputs.estimates))
          conditions.push_back(moved(estimate, run));
  }
  return conditions;
}
} // namespace pelvireg::report
