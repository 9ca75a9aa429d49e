#include "validation/runner/evaluate.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/contour_distance.h"
#include "validation/metrics/penetration.h"
#include "validation/metrics/surface_distance.h"
#include "validation/metrics/surface_samples.h"
#include "validation/runner/evaluate_checks.h"
#include "validation/runner/outer_surface.h"
#include "validation/runner/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <tuple>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;
using dataset::Points;

/// The truth's share in every comparison of one organ.
struct TruthOrgan
{
  const dataset::TruthSurface *surface = nullptr;
  std::vector<Points> samples;                          ///< one an increment, mm
  std::map<int, std::vector<metrics::CutSegment>> cuts; ///< by slice index, last increment; missed slices are absent
};

/// One run to be judged; the rest mesh is a run whose positions never change.
struct Run
{
  std::string condition;
  int sample = 0;
  const dataset::EstimateSample *estimate = nullptr; ///< null: unregistered
};

struct RunResult
{
  std::vector<StepError> by_step;
  std::vector<SliceError> by_slice;
  std::vector<MissedSlice> missed_slices;
  std::vector<OrganPenetration> penetrations;
};

struct Context
{
  const dataset::Anatomy &anatomy;
  const EvaluateOptions &options;
  std::vector<TruthOrgan> truth;             ///< organ_names in order
  std::vector<dataset::SurfaceMesh> unmoved; ///< rest surfaces of the registration, organ_names in order
  int n_increments = 0;
  int steps_per_increment = 0;
};

Points moved(const dataset::TruthSurface &surface, int increment)
{
  return surface.rest.points + surface.displacements[static_cast<std::size_t>(increment) - 1];
}

TruthOrgan prepare_truth(const dataset::TruthSurface &surface, const dataset::Anatomy &anatomy,
                         const EvaluateOptions &options)
{
  TruthOrgan organ;
  organ.surface = &surface;
  const auto samples = metrics::sample_surface(surface.rest, options.surface_spacing);
  const int n_increments = static_cast<int>(surface.displacements.size());
  for (int increment = 1; increment <= n_increments; ++increment)
    organ.samples.push_back(metrics::sample_positions(samples, surface.rest.triangles, moved(surface, increment)));
  for (int k = -anatomy.n_slices_each_side; k <= anatomy.n_slices_each_side; ++k)
  {
    auto cut = metrics::cut_surface(moved(surface, n_increments), surface.rest.triangles, surface.rest.region,
                                    metrics::slice_plane(anatomy.dyn_plane, k, anatomy.slice_pitch));
    if (!cut.empty())
      organ.cuts.emplace(k, std::move(cut));
  }
  if (!organ.cuts.contains(0))
    throw InputError(
        fmt::format("evaluate: the DYN plane misses the truth's {} at the last increment, it must cut every "
                    "organ; check the case's DYN plane",
                    surface.name));
  return organ;
}

const dataset::SurfaceMesh &rest_surface(const Context &context, const Run &run, std::size_t organ)
{
  return run.estimate ? run.estimate->surfaces[organ].rest : context.unmoved[organ];
}

const Points &positions(const Context &context, const Run &run, std::size_t organ, int step)
{
  return run.estimate ? run.estimate->surfaces[organ].positions[static_cast<std::size_t>(step) - 1]
                      : context.unmoved[organ].points;
}

void judge_steps(const Context &context, const Run &run, std::size_t organ, RunResult &result)
{
  const dataset::SurfaceMesh &rest = rest_surface(context, run, organ);
  const int n_steps = context.n_increments * context.steps_per_increment;
  for (int step = 1; step <= n_steps; ++step)
  {
    const int increment = (step + context.steps_per_increment - 1) / context.steps_per_increment;
    const Points &samples = context.truth[organ].samples[static_cast<std::size_t>(increment) - 1];
    const auto distances =
        metrics::surface_distances(samples, positions(context, run, organ, step), rest.triangles, rest.region);
    result.by_step.push_back({run.condition, run.sample, organ_names[organ], step, metrics::describe(distances)});
  }
}

void judge_slices(const Context &context, const Run &run, std::size_t organ, RunResult &result)
{
  const dataset::SurfaceMesh &rest = rest_surface(context, run, organ);
  const int last_step = context.n_increments * context.steps_per_increment;
  for (const auto &[k, truth_cut] : context.truth[organ].cuts)
  {
    const auto estimate_cut =
        metrics::cut_surface(positions(context, run, organ, last_step), rest.triangles, rest.region,
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

bool are_attached(const dataset::RegistrationModel &model, const std::string &a, const std::string &b)
{
  return std::any_of(model.attachments.begin(), model.attachments.end(),
                     [&](const dataset::RegistrationAttachment &attachment)
                     { return std::minmax(attachment.body_a, attachment.body_b) == std::minmax(a, b); });
}

void judge_penetration(const Context &context, const Run &run, std::size_t a, std::size_t b, RunResult &result)
{
  OrganPenetration pair{run.condition, run.sample, organ_names[a], organ_names[b], false, 0, 0, 0};
  pair.is_attached = are_attached(context.anatomy.registration, pair.organ_a, pair.organ_b);
  const int last_step = context.n_increments * context.steps_per_increment;
  // The unregistered meshes stay at rest: one position stands for all.
  for (int step = run.estimate ? context.steps_per_increment : last_step; step <= last_step;
       step += context.steps_per_increment)
  {
    const auto surface = [&](std::size_t organ)
    {
      const dataset::SurfaceMesh &rest = rest_surface(context, run, organ);
      return dataset::SurfaceMesh{positions(context, run, organ, step), rest.triangles, rest.region};
    };
    pair.last = metrics::penetration(surface(a), surface(b)).depth;
    if (pair.last > pair.deepest)
    {
      pair.deepest = pair.last;
      pair.step_of_deepest = step;
    }
  }
  result.penetrations.push_back(pair);
}

RunResult judge(const Context &context, const Run &run)
{
  RunResult result;
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
  {
    judge_steps(context, run, organ, result);
    judge_slices(context, run, organ, result);
    for (std::size_t other = organ + 1; other < organ_names.size(); ++other)
      judge_penetration(context, run, organ, other, result);
  }
  return result;
}

int condition_rank(const std::string &condition)
{
  const std::vector<std::string> first = {unregistered, "no_boundary_conditions", "full"};
  return static_cast<int>(std::find(first.begin(), first.end(), condition) - first.begin());
}

std::vector<Run> runs_in_order(const std::vector<dataset::Estimate> &estimates)
{
  std::vector<Run> runs = {{unregistered, 0, nullptr}};
  for (const dataset::Estimate &estimate : estimates)
    for (const dataset::EstimateSample &sample : estimate.samples)
      runs.push_back({estimate.label(), sample.sample, &sample});
  std::sort(runs.begin(), runs.end(),
            [](const Run &a, const Run &b)
            {
              return std::tuple(condition_rank(a.condition), a.condition, a.sample) <
                     std::tuple(condition_rank(b.condition), b.condition, b.sample);
            });
  return runs;
}

OrganMotion motion_of(const dataset::TruthSurface &surface, const dataset::SurfaceMesh &unmoved,
                      const dataset::Plane &plane, double spacing)
{
  const auto samples = metrics::sample_surface(surface.rest, spacing);
  const Points displacement = metrics::sample_positions(samples, surface.rest.triangles, surface.displacements.back());
  const Eigen::VectorXd length = displacement.rowwise().norm();
  const Eigen::VectorXd off_plane = (displacement * plane.normal).cwiseAbs();
  const Points rest = metrics::sample_positions(samples, surface.rest.triangles, surface.rest.points);
  return {surface.name,
          length.mean(),
          length.maxCoeff(),
          off_plane.mean(),
          off_plane.maxCoeff(),
          metrics::describe(metrics::surface_distances(rest, unmoved.points, unmoved.triangles, unmoved.region))};
}

/// Rest-arc-length mean of the in-plane displacement of the outer contour in the DYN plane (DESIGN 4), mm.
double mean_in_plane_displacement(const dataset::TruthSurface &surface, const dataset::Plane &plane)
{
  double length = 0, sum = 0;
  const auto in_plane = [&](const metrics::EdgeCut &cut)
  {
    const Eigen::Vector3d displacement = cut.interpolate(surface.displacements.back());
    return (displacement - displacement.dot(plane.normal) * plane.normal).norm();
  };
  for (const auto &segment :
       metrics::cut_surface(surface.rest.points, surface.rest.triangles, surface.rest.region, plane))
  {
    length += segment.length();
    sum += segment.length() * 0.5 * (in_plane(segment.ends[0]) + in_plane(segment.ends[1]));
  }
  if (!(length > 0))
    throw InputError(
        fmt::format("evaluate: the DYN plane misses the {} at rest, it must cut every organ; check the case's "
                    "DYN plane",
                    surface.name));
  return sum / length;
}

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
    quality.largest_out_of_plane_force = std::max(quality.largest_out_of_plane_force, record.out_of_plane_force);
    quality.largest_in_plane_force = std::max(quality.largest_in_plane_force, record.in_plane_force);
    if (step % steps_per_increment != 0)
      continue;
    quality.largest_mean_residual = std::max(quality.largest_mean_residual, record.in_plane_residual);
    quality.largest_residual = std::max(quality.largest_residual, record.max_in_plane_residual);
  }
  return quality;
}

Evaluation describe_truth(const Context &context, const dataset::Truth &truth)
{
  Evaluation evaluation;
  evaluation.case_name = context.anatomy.case_name;
  evaluation.truth_source = truth.source;
  evaluation.n_increments = context.n_increments;
  evaluation.steps_per_increment = context.steps_per_increment;
  evaluation.slice_pitch = context.anatomy.slice_pitch;
  evaluation.n_slices_each_side = context.anatomy.n_slices_each_side;
  evaluation.options = context.options;
  evaluation.options.progress = nullptr;
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    evaluation.motion.push_back(motion_of(*context.truth[organ].surface, context.unmoved[organ],
                                          context.anatomy.dyn_plane, context.options.surface_spacing));
  const auto vagina =
      static_cast<std::size_t>(std::find(organ_names.begin(), organ_names.end(), "vagina") - organ_names.begin());
  evaluation.vaginal_displacement =
      mean_in_plane_displacement(*context.truth[vagina].surface, context.anatomy.dyn_plane);
  if (!truth.increments.empty())
    evaluation.reported_vaginal_displacement = truth.increments.back().mean_vaginal_displacement;
  return evaluation;
}

Context prepare(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const EvaluateOptions &options)
{
  Context context{anatomy, options, {}, {}, 0, anatomy.registration_steps_per_increment};
  for (const std::string &organ : organ_names)
  {
    context.truth.push_back(prepare_truth(truth_surface(truth, organ), anatomy, options));
    const int body = body_index(anatomy.registration, organ);
    context.unmoved.push_back(outer_surface(anatomy.registration.bodies[static_cast<std::size_t>(body)]).rest);
  }
  context.n_increments = static_cast<int>(context.truth.front().samples.size());
  return context;
}
} // namespace

Evaluation evaluate(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                    const std::vector<dataset::Estimate> &estimates, const EvaluateOptions &options)
{
  require_comparable(anatomy, truth, estimates);
  const Context context = prepare(anatomy, truth, options);
  const std::vector<Run> runs = runs_in_order(estimates);

  std::vector<RunResult> results(runs.size());
  std::mutex progress_mutex;
  int n_done = 0;
  for_each_index(static_cast<int>(runs.size()), options.n_threads,
                 [&](int i)
                 {
                   results[static_cast<std::size_t>(i)] = judge(context, runs[static_cast<std::size_t>(i)]);
                   const std::lock_guard lock(progress_mutex);
                   ++n_done;
                   if (options.progress)
                     options.progress(n_done / static_cast<double>(runs.size()),
                                      fmt::format("judged run {} of {}", n_done, runs.size()));
                 });

  Evaluation evaluation = describe_truth(context, truth);
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const RunResult &result = results[i];
    evaluation.by_step.insert(evaluation.by_step.end(), result.by_step.begin(), result.by_step.end());
    evaluation.by_slice.insert(evaluation.by_slice.end(), result.by_slice.begin(), result.by_slice.end());
    evaluation.missed_slices.insert(evaluation.missed_slices.end(), result.missed_slices.begin(),
                                    result.missed_slices.end());
    evaluation.penetrations.insert(evaluation.penetrations.end(), result.penetrations.begin(),
                                   result.penetrations.end());
    if (evaluation.conditions.empty() || evaluation.conditions.back() != runs[i].condition)
      evaluation.conditions.push_back(runs[i].condition);
    if (runs[i].estimate)
      evaluation.quality.push_back(quality_of(runs[i], context.steps_per_increment));
  }
  return evaluation;
}
} // namespace pelvireg::runner
