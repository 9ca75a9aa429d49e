#include "validation/runner/judge_run.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/contour_distance.h"
#include "validation/metrics/enclosed_volume.h"
#include "validation/metrics/material_points.h"
#include "validation/metrics/offset_bins.h"
#include "validation/metrics/penetration.h"
#include "validation/metrics/rigid_rotation.h"
#include "validation/runner/outer_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;
using dataset::Points;

/// A run with the rest meshes that it started from.
class Judged
{
public:
  Judged(const Context &context, const Run &run) : context_(context), run_(run)
  {
    for (std::size_t organ = 0; run.estimate && organ < organ_names.size(); ++organ)
    {
      const dataset::SurfaceMesh &mesh = run.estimate->surfaces[organ].rest;
      const dataset::SurfaceMesh &nominal = context.unmoved[organ].mesh;
      if (mesh.points == nominal.points && mesh.triangles == nominal.triangles && mesh.region == nominal.region)
        own_rest_.emplace_back();
      else
        own_rest_.emplace_back(prepare_rest(mesh, context.truth[organ], context.options.surface_spacing));
    }
  }

  const RestOrgan &rest(std::size_t organ) const
  {
    return run_.estimate && own_rest_[organ] ? *own_rest_[organ] : context_.unmoved[organ];
  }
  const Points &positions(std::size_t organ, int step) const
  {
    return run_.estimate ? run_.estimate->surfaces[organ].positions[static_cast<std::size_t>(step) - 1]
                         : context_.unmoved[organ].mesh.points;
  }
  const TruthIncrement &truth(std::size_t organ, int step) const
  {
    const int increment = (step + context_.steps_per_increment - 1) / context_.steps_per_increment;
    return context_.truth[organ].increments[static_cast<std::size_t>(increment) - 1];
  }

private:
  const Context &context_;
  const Run &run_;
  std::vector<std::optional<RestOrgan>> own_rest_;
};

/// The organs of one run at one step, made ready for comparison with the truth and with each other.
struct Position
{
  std::vector<metrics::ProbedSurface> surfaces;
  std::vector<metrics::InsideIntervals> insides;

  Position(const Judged &run, int step, double line_spacing)
  {
    for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    {
      const dataset::SurfaceMesh &mesh = run.rest(organ).mesh;
      surfaces.emplace_back(run.positions(organ, step), mesh.triangles, mesh.region);
      insides.emplace_back(run.positions(organ, step), mesh.triangles, line_spacing);
    }
  }
};

/// How far the estimate's material points are from the truth's: k x 3, mm.
Points material_errors(const Judged &judged, const Context &context, std::size_t organ, int step)
{
  const RestOrgan &rest = judged.rest(organ);
  const Points displacements = metrics::sample_positions(rest.material_points, rest.mesh.triangles,
                                                         judged.positions(organ, step) - rest.mesh.points);
  return displacements - (judged.truth(organ, step).samples - context.truth[organ].rest_samples);
}

void judge_slices(const Context &context, const Run &run, const Judged &judged, std::size_t organ, RunResult &result)
{
  const dataset::SurfaceMesh &mesh = judged.rest(organ).mesh;
  for (const auto &[k, truth_cut] : context.truth[organ].cuts)
  {
    const auto estimate_cut =
        metrics::cut_surface(judged.positions(organ, context.last_step()), mesh.triangles, mesh.region,
                             metrics::slice_plane(context.anatomy.dyn_plane, k, context.anatomy.slice_pitch));
    if (estimate_cut.empty())
    {
      if (k == 0)
        throw InputError(fmt::format("evaluate: the DYN plane misses the {} of condition '{}', sample {}, at the last "
                                     "step, it must cut every organ; the registration has lost it",
                                     organ_names[organ], run.condition, run.sample));
      result.missed_slices.push_back(
          {run.condition, run.sample, organ_names[organ], k, metrics::contour_length(truth_cut)});
      continue;
    }
    const auto distances = metrics::contour_distances(truth_cut, estimate_cut, context.options.contour_spacing);
    result.by_slice.push_back({run.condition, run.sample, organ_names[organ], k, k * context.anatomy.slice_pitch,
                               metrics::describe(distances)});
  }
}

/// `there`: distances of the truth's samples to the organ, mm.
StepMetrics measure(const Context &context, const Run &run, const Judged &judged, const Position &position,
                    std::size_t organ, int step, const std::vector<double> &there)
{
  const TruthIncrement &truth = judged.truth(organ, step);
  const RestOrgan &rest = judged.rest(organ);
  const Points &positions = judged.positions(organ, step);
  const Points errors = material_errors(judged, context, organ, step);
  const auto back = metrics::surface_distances(
      metrics::sample_positions(rest.own_samples, rest.mesh.triangles, positions), truth.surface);

  StepMetrics row;
  row.condition = run.condition;
  row.sample = run.sample;
  row.organ = organ_names[organ];
  row.step = step;
  row.material = metrics::material_error(errors, truth.normals);
  row.symmetric = metrics::symmetric_distance(there, back);
  row.dice = metrics::dice(truth.inside, position.insides[organ]);
  row.volume = metrics::enclosed_volume(positions, rest.mesh.triangles);
  row.truth_volume = truth.volume;
  row.rest_volume = rest.volume;
  row.truth_rest_volume = context.truth[organ].rest_volume;
  row.rotation_error = metrics::rotation_angle(metrics::best_rotation(truth.samples + errors, truth.samples));
  row.truth_rotation = truth.rotation;
  return row;
}

/// `distances` of the truth's samples to the organ at the last step, mm.
void judge_distances(const Context &context, const Run &run, const Judged &judged, std::size_t organ,
                     const std::vector<double> &distances, RunResult &result)
{
  const Eigen::VectorXd lengths = material_errors(judged, context, organ, context.last_step()).rowwise().norm();
  const std::vector<double> &offsets = context.truth[organ].offsets;
  const double pitch = context.anatomy.slice_pitch;
  const auto surface_bins = metrics::bin_by_offset(offsets, distances, pitch);
  const auto material_bins = metrics::bin_by_offset(offsets, {lengths.begin(), lengths.end()}, pitch);
  for (std::size_t i = 0; i < surface_bins.size(); ++i)
    result.by_distance.push_back({run.condition, run.sample, organ_names[organ], surface_bins[i].index,
                                  surface_bins[i].values, material_bins[i].values.mean});
}

bool are_attached(const dataset::RegistrationModel &model, const std::string &a, const std::string &b)
{
  return std::any_of(model.attachments.begin(), model.attachments.end(),
                     [&](const dataset::RegistrationAttachment &attachment)
                     { return std::minmax(attachment.body_a, attachment.body_b) == std::minmax(a, b); });
}

std::vector<OrganPenetration> organ_pairs(const Context &context, const Run &run)
{
  std::vector<OrganPenetration> pairs;
  for (std::size_t a = 0; a < organ_names.size(); ++a)
    for (std::size_t b = a + 1; b < organ_names.size(); ++b)
      pairs.push_back({.condition = run.condition,
                       .sample = run.sample,
                       .organ_a = organ_names[a],
                       .organ_b = organ_names[b],
                       .is_attached = are_attached(context.anatomy.registration, organ_names[a], organ_names[b])});
  return pairs;
}

void judge_penetration(const Position &position, int step, std::vector<OrganPenetration> &pairs)
{
  auto pair = pairs.begin();
  for (std::size_t a = 0; a < organ_names.size(); ++a)
    for (std::size_t b = a + 1; b < organ_names.size(); ++b, ++pair)
    {
      pair->last = metrics::penetration(position.surfaces[a], position.surfaces[b]).depth;
      pair->last_volume = position.insides[a].common_volume(position.insides[b]);
      pair->largest_volume = std::max(pair->largest_volume, pair->last_volume);
      if (pair->last > pair->deepest)
      {
        pair->deepest = pair->last;
        pair->step_of_deepest = step;
      }
    }
}

/// The steps within a position: only how far the surface is.
void judge_step(const Run &run, const Judged &judged, int step, std::vector<RunResult> &by_organ)
{
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    const dataset::SurfaceMesh &mesh = judged.rest(organ).mesh;
    const auto distances = metrics::surface_distances(judged.truth(organ, step).samples, judged.positions(organ, step),
                                                      mesh.triangles, mesh.region);
    by_organ[organ].by_step.push_back(
        {run.condition, run.sample, organ_names[organ], step, metrics::describe(distances)});
  }
}

/// The last step of a position: everything.
void judge_position(const Context &context, const Run &run, const Judged &judged, int step,
                    std::vector<RunResult> &by_organ, std::vector<OrganPenetration> &pairs)
{
  const Position position(judged, step, context.options.line_spacing);
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    RunResult &result = by_organ[organ];
    const auto distances =
        metrics::surface_distances(judged.truth(organ, step).samples, position.surfaces[organ].tree());
    result.by_step.push_back({run.condition, run.sample, organ_names[organ], step, metrics::describe(distances)});
    result.metrics_by_step.push_back(measure(context, run, judged, position, organ, step, distances));
    if (step == context.last_step())
      judge_distances(context, run, judged, organ, distances, result);
  }
  judge_penetration(position, step, pairs);
}

void judge_elements(const Context &context, const Run &run, RunResult &result)
{
  if (!run.estimate)
    return;
  const dataset::RegistrationModel &model = context.anatomy.registration;
  for (const dataset::BodyNodes &nodes : run.estimate->bodies)
  {
    const dataset::RegistrationBody &body = model.bodies[static_cast<std::size_t>(body_index(model, nodes.name))];
    result.elements.push_back({run.condition, run.sample, body.name,
                               metrics::element_jacobian(nodes.rest, nodes.last, body.tets, body.hexes)});
  }
}

/// What a run says of itself.
RunQuality quality_of(const Run &run, int steps_per_increment)
{
  RunQuality quality;
  quality.condition = run.condition;
  quality.sample = run.sample;
  quality.n_steps = static_cast<int>(run.estimate->steps.size());
  quality.least_acceptance = 1;
  for (int step = 1; step <= quality.n_steps; ++step)
  {
    const dataset::StepRecord &record = run.estimate->steps[static_cast<std::size_t>(step) - 1];
    quality.n_failed_steps += record.status != "ok";
    const double acceptance = record.offered_control_points > 0
                                  ? static_cast<double>(record.accepted_control_points) / record.offered_control_points
                                  : 0.0;
    quality.least_acceptance = std::min(quality.least_acceptance, acceptance);
    quality.mean_outline_constraints += record.accepted_control_points / static_cast<double>(quality.n_steps);
    quality.mean_contacts += record.contacts / static_cast<double>(quality.n_steps);
    quality.largest_out_of_plane_force = std::max(quality.largest_out_of_plane_force, record.out_of_plane_force);
    quality.largest_in_plane_force = std::max(quality.largest_in_plane_force, record.in_plane_force);
    if (step % steps_per_increment != 0)
      continue;
    quality.largest_mean_residual = std::max(quality.largest_mean_residual, record.in_plane_residual);
    quality.largest_residual = std::max(quality.largest_residual, record.max_in_plane_residual);
  }
  return quality;
}
} // namespace

RestOrgan prepare_rest(const dataset::SurfaceMesh &mesh, const TruthOrgan &truth, double spacing)
{
  return {mesh, metrics::sample_surface(mesh, spacing), metrics::closest_samples(mesh, truth.rest_samples),
          metrics::enclosed_volume(mesh.points, mesh.triangles)};
}

RunResult judge(const Context &context, const Run &run)
{
  const Judged judged(context, run);
  RunResult result;
  result.penetrations = organ_pairs(context, run);
  std::vector<RunResult> by_organ(organ_names.size());
  for (int step = 1; step <= context.last_step(); ++step)
    try
    {
      if (step % context.steps_per_increment == 0)
        judge_position(context, run, judged, step, by_organ, result.penetrations);
      else
        judge_step(run, judged, step, by_organ);
    }
    catch (const InputError &error)
    {
      throw InputError(fmt::format("evaluate: condition '{}', sample {}, step {}: {}", run.condition, run.sample, step,
                                   error.what()));
    }
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    append(result.by_step, by_organ[organ].by_step);
    append(result.metrics_by_step, by_organ[organ].metrics_by_step);
    append(result.by_distance, by_organ[organ].by_distance);
    judge_slices(context, run, judged, organ, result);
  }
  judge_elements(context, run, result);
  if (run.estimate)
    result.quality = quality_of(run, context.steps_per_increment);
  return result;
}
} // namespace pelvireg::runner
