#include "validation/runner/evaluate_checks.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/enclosed_volume.h"
#include "validation/metrics/surface_distance.h"
#include "validation/runner/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

void require_same_case(const std::string &what, const std::string &got, const std::string &wanted)
{
  if (got != wanted)
    throw InputError(fmt::format(
        "evaluate: {} is of case '{}', the anatomy is '{}'; run the chain again in one directory", what, got, wanted));
}

/// A surface and its fields, one (n x 3) a step; `where` names it in the message.
void require_usable_field(const dataset::SurfaceMesh &rest, const std::vector<dataset::Points> &field,
                          std::size_t n_wanted, const std::string &where)
{
  try
  {
    metrics::require_usable_surface(rest.points, rest.triangles, rest.region);
    metrics::require_closed(rest.triangles);
  }
  catch (const InputError &error)
  {
    throw InputError(fmt::format("evaluate: {}: {}", where, error.what()));
  }
  if (field.size() != n_wanted)
    throw InputError(
        fmt::format("evaluate: {} has {} steps, must have {}; run that stage again", where, field.size(), n_wanted));
  for (std::size_t step = 0; step < field.size(); ++step)
  {
    if (field[step].rows() != rest.points.rows())
      throw InputError(fmt::format("evaluate: {}, step {} has {} nodes, the rest surface has {}; run that stage again",
                                   where, step + 1, field[step].rows(), rest.points.rows()));
    for (Eigen::Index node = 0; node < field[step].rows(); ++node)
      if (!field[step].row(node).allFinite())
        throw InputError(
            fmt::format("evaluate: {}, step {}, node {} is ({}, {}, {}), must be finite; run that stage again", where,
                        step + 1, node, field[step](node, 0), field[step](node, 1), field[step](node, 2)));
  }
}

/// The name becomes a field of CSV files.
void require_condition_name(const std::string &condition)
{
  const bool is_word =
      condition.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos && !condition.empty();
  if (!is_word || condition == unregistered)
    throw InputError(fmt::format("evaluate: an estimate's condition is '{}', must be lower-case letters, digits and "
                                 "underscores and not '{}'; register again",
                                 condition, unregistered));
}

void require_usable_truth(const dataset::Anatomy &anatomy, const dataset::Truth &truth)
{
  require_same_case("the truth", truth.case_name, anatomy.case_name);
  const auto n_increments = static_cast<std::size_t>(anatomy.reference.n_increments);
  if (anatomy.reference.n_increments < 1 || anatomy.registration_steps_per_increment < 1)
    throw InputError(fmt::format("evaluate: the case has {} increments of {} steps, both must be at least 1",
                                 anatomy.reference.n_increments, anatomy.registration_steps_per_increment));
  for (const std::string &organ : organ_names)
  {
    const dataset::TruthSurface &surface = truth_surface(truth, organ);
    require_usable_field(surface.rest, surface.displacements, n_increments, fmt::format("the truth's {}", organ));
  }
}

void require_finite_record(const dataset::StepRecord &record, const std::string &where)
{
  for (const double value : {record.in_plane_residual, record.max_in_plane_residual, record.attachment_residual,
                             record.out_of_plane_force, record.in_plane_force})
    if (!std::isfinite(value))
      throw InputError(
          fmt::format("evaluate: {}: a residual or force is {}, must be finite; register again", where, value));
}

} // namespace

void require_usable_run(const std::string &label, const dataset::EstimateSample &sample, int n_steps)
{
  const std::string where = fmt::format("estimate '{}', sample {}", label, sample.sample);
  const auto n_wanted = static_cast<std::size_t>(n_steps);
  if (sample.surfaces.size() != organ_names.size())
    throw InputError(fmt::format("evaluate: {} has {} organs, must have {}; register again", where,
                                 sample.surfaces.size(), organ_names.size()));
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    const dataset::EstimateSurface &surface = sample.surfaces[organ];
    if (surface.name != organ_names[organ])
      throw InputError(fmt::format("evaluate: organ {} of {} is '{}', must be '{}'; register again", organ + 1, where,
                                   surface.name, organ_names[organ]));
    require_usable_field(surface.rest, surface.positions, n_wanted, fmt::format("{}, {}", where, surface.name));
  }
  if (sample.steps.size() != n_wanted)
    throw InputError(fmt::format("evaluate: {} has {} step records, must have {}; register again", where,
                                 sample.steps.size(), n_wanted));
  for (const dataset::StepRecord &record : sample.steps)
    require_finite_record(record, where);
}

const dataset::TruthSurface &truth_surface(const dataset::Truth &truth, const std::string &organ)
{
  for (const dataset::TruthSurface &surface : truth.surfaces)
    if (surface.name == organ)
      return surface;
  throw InputError(fmt::format("evaluate: the truth has no surface '{}', all of {} are needed; run the reference again",
                               organ, fmt::join(organ_names, ", ")));
}

void require_comparable(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                        const std::vector<RunSource> &estimates)
{
  require_usable_truth(anatomy, truth);
  std::set<std::pair<std::string, int>> seen;
  for (const RunSource &estimate : estimates)
  {
    const std::string label = estimate.description.label();
    require_same_case(fmt::format("estimate '{}'", label), estimate.description.case_name, anatomy.case_name);
    require_condition_name(label);
    if (estimate.numbers.empty())
      throw InputError(fmt::format("evaluate: estimate '{}' holds no run; register again", label));
    for (const int number : estimate.numbers)
      if (!seen.emplace(label, number).second)
        throw InputError(
            fmt::format("evaluate: estimate '{}', sample {} is there twice; pass each run once", label, number));
  }
}
} // namespace pelvireg::runner
