#include "validation/runner/evaluate.h"
#include "synthetic/dataset/parallel.h"

#include "validation/runner/evaluate_checks.h"
#include "validation/runner/judge_run.h"
#include "validation/runner/node_table.h"
#include "validation/runner/outer_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

int condition_rank(const std::string &condition)
{
  const std::vector<std::string> first = {unregistered, "no_boundary_conditions", "full"};
  return static_cast<int>(std::find(first.begin(), first.end(), condition) - first.begin());
}

/// A run that has yet to be fetched; `source` is null for unregistered.
struct RunToJudge
{
  std::string condition;
  int sample = 0;
  const RunSource *source = nullptr;
  std::size_t index = 0; ///< in the source
};

std::vector<RunToJudge> runs_in_order(const std::vector<RunSource> &estimates)
{
  std::vector<RunToJudge> runs = {{unregistered}};
  for (const RunSource &estimate : estimates)
    for (std::size_t i = 0; i < estimate.numbers.size(); ++i)
      runs.push_back({estimate.description.label(), estimate.numbers[i], &estimate, i});
  std::sort(runs.begin(), runs.end(),
            [](const RunToJudge &a, const RunToJudge &b)
            {
              return std::tuple(condition_rank(a.condition), a.condition, a.sample) <
                     std::tuple(condition_rank(b.condition), b.condition, b.sample);
            });
  return runs;
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
  {
    evaluation.motion.push_back(
        motion_of(context.truth[organ], context.unmoved[organ].mesh, context.anatomy.dyn_plane));
    append(evaluation.sections, context.truth[organ].sections);
  }
  const auto vagina =
      static_cast<std::size_t>(std::find(organ_names.begin(), organ_names.end(), "vagina") - organ_names.begin());
  evaluation.vaginal_displacement =
      mean_in_plane_displacement(*context.truth[vagina].surface, context.anatomy.dyn_plane);
  evaluation.is_inverse_crime = truth.source.rfind(dataset::truth_of_registration, 0) == 0;
  evaluation.registration_nodes = body_sizes(context.anatomy.registration);
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
    context.unmoved.push_back(
        prepare_rest(outer_surface(anatomy.registration.bodies[static_cast<std::size_t>(body)]).rest,
                     context.truth.back(), options.surface_spacing));
  }
  context.n_increments = static_cast<int>(context.truth.front().increments.size());
  return context;
}

/// The run is in memory while it is judged.
RunResult fetch_and_judge(const Context &context, const RunToJudge &run)
{
  if (!run.source)
    return judge(context, {run.condition, run.sample, nullptr});
  const auto estimate = run.source->run(run.index);
  require_usable_run(run.condition, *estimate, context.last_step());
  return judge(context, {run.condition, run.sample, estimate.get()});
}

/// The results in the order of the runs.
std::vector<RunResult> judge_all(const Context &context, const std::vector<RunToJudge> &runs)
{
  std::vector<RunResult> results(runs.size());
  const EvaluateOptions &options = context.options;
  std::mutex progress_mutex;
  int n_done = 0;
  dataset::for_each_index(static_cast<int>(runs.size()), options.n_threads,
                          [&](int i)
                          {
                            results[static_cast<std::size_t>(i)] =
                                fetch_and_judge(context, runs[static_cast<std::size_t>(i)]);
                            const std::lock_guard lock(progress_mutex);
                            ++n_done;
                            if (options.progress)
                              options.progress(n_done / static_cast<double>(runs.size()),
                                               fmt::format("judged run {} of {}", n_done, runs.size()));
                          });
  return results;
}
} // namespace

Evaluation evaluate_runs(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                         const std::vector<RunSource> &estimates, const EvaluateOptions &options)
{
  require_comparable(anatomy, truth, estimates);
  const Context context = prepare(anatomy, truth, options);
  const std::vector<RunToJudge> runs = runs_in_order(estimates);
  std::vector<RunResult> results = judge_all(context, runs);

  Evaluation evaluation = describe_truth(context, truth);
  for (const RunSource &estimate : estimates)
  {
    const dataset::Perturbation &perturbation = estimate.description.perturbation;
    evaluation.perturbations[estimate.description.label()] = perturbation.kind;
    evaluation.modulus_spreads[estimate.description.label()] = perturbation.modulus_spread;
  }
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const RunResult result = std::move(results[i]);
    append(evaluation.by_step, result.by_step);
    append(evaluation.by_slice, result.by_slice);
    append(evaluation.metrics_by_step, result.metrics_by_step);
    append(evaluation.by_distance, result.by_distance);
    append(evaluation.elements, result.elements);
    append(evaluation.missed_slices, result.missed_slices);
    append(evaluation.penetrations, result.penetrations);
    if (evaluation.conditions.empty() || evaluation.conditions.back() != runs[i].condition)
      evaluation.conditions.push_back(runs[i].condition);
    if (result.quality)
      evaluation.quality.push_back(*result.quality);
  }
  return evaluation;
}

Evaluation evaluate(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                    const std::vector<dataset::Estimate> &estimates, const EvaluateOptions &options)
{
  std::vector<RunSource> sources;
  sources.reserve(estimates.size());
  for (const dataset::Estimate &estimate : estimates)
    sources.push_back(runs_of(estimate));
  return evaluate_runs(anatomy, truth, sources, options);
}
} // namespace pelvireg::runner
