#include "validation/runner/register.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/parallel.h"
#include "validation/runner/outer_surface.h"
#include "validation/runner/perturbation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

registration::Body convert(const dataset::RegistrationBody &body)
{
  registration::Body converted;
  converted.name = body.name;
  converted.rest_positions = body.points;
  converted.tets = body.tets;
  converted.hexes = body.hexes;
  converted.youngs_modulus = body.youngs_modulus;
  converted.poisson_ratio = body.poisson_ratio;
  converted.density = body.density;
  converted.fixed_nodes.assign(body.fixed_nodes.begin(), body.fixed_nodes.end());
  converted.outer_triangles = body.outer_triangles;
  for (const std::int32_t region : body.outer_region)
    converted.is_wall.push_back(region != static_cast<std::int32_t>(dataset::SurfaceRegion::cap));
  return converted;
}

registration::Model convert(const dataset::RegistrationModel &model)
{
  registration::Model converted;
  for (const dataset::RegistrationBody &body : model.bodies)
    converted.bodies.push_back(convert(body));
  for (const dataset::RegistrationAttachment &attachment : model.attachments)
    converted.attachments.push_back({attachment.name,
                                     body_index(model, attachment.body_a),
                                     {attachment.nodes_a.begin(), attachment.nodes_a.end()},
                                     body_index(model, attachment.body_b),
                                     0.0});
  // What the registration may know: organs do not run through each other, whichever two. Which of them touch, and when,
  // is for it to find out.
  for (std::size_t a = 0; a < organ_names.size(); ++a)
    for (std::size_t b = a + 1; b < organ_names.size(); ++b)
      converted.contact_pairs.push_back({body_index(model, organ_names[a]), body_index(model, organ_names[b])});
  return converted;
}

registration::Observation convert(const dataset::DynamicFrame &frame, const dataset::Plane &plane,
                                  const dataset::RegistrationModel &model)
{
  registration::Observation observation;
  observation.plane_origin = plane.origin;
  observation.plane_normal = plane.normal;
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    if (frame.control_points[organ].rows() > 0)
      observation.outlines.push_back(
          {body_index(model, organ_names[organ]), frame.control_points[organ], frame.control_point_normals[organ]});
  return observation;
}

dataset::StepRecord convert(const registration::StepSummary &summary,
                            const std::vector<registration::PairPenetration> &penetrations)
{
  dataset::StepRecord record;
  record.status = summary.status == registration::StepStatus::ok ? "ok" : registration::to_string(summary.status);
  record.offered_control_points = summary.offered_control_points;
  record.accepted_control_points = summary.accepted_control_points;
  record.in_plane_residual = summary.mean_in_plane_residual;
  record.max_in_plane_residual = summary.max_in_plane_residual;
  record.attachment_residual = summary.attachment_residual;
  record.out_of_plane_force = summary.out_of_plane_force;
  record.in_plane_force = summary.in_plane_force;
  record.solver_sweeps = summary.sweeps;
  record.contacts = summary.n_contacts;
  record.contact_force = summary.contact_force;
  record.contact_residual = summary.contact_motion_residual;
  record.friction_cone_violation = summary.cone_violation;
  record.open_rays = summary.n_open_rays;
  for (const registration::PairPenetration &pair : penetrations)
  {
    record.penetration_depth.push_back(pair.depth);
    record.penetration_volume.push_back(pair.volume);
  }
  return record;
}

void require_usable(const dataset::Anatomy &anatomy, const dataset::Observations &observations)
{
  if (anatomy.registration_steps_per_increment < 1)
    throw InputError(fmt::format("register: the case plays an increment {} times, must be at least once",
                                 anatomy.registration_steps_per_increment));
  if (observations.case_name != anatomy.case_name)
    throw InputError(fmt::format("register: observations are of case '{}', the anatomy is '{}'; observe again",
                                 observations.case_name, anatomy.case_name));
  if (observations.frames.empty())
    throw InputError("register: observations hold no frame, at least one is needed; observe again");
  for (const dataset::DynamicFrame &frame : observations.frames)
    if (frame.control_points.size() != organ_names.size() || frame.control_point_normals.size() != organ_names.size())
      throw InputError(fmt::format("register: frame {} has control points of {} organs and normals of {}, must be {} "
                                   "each; observe again",
                                   frame.increment, frame.control_points.size(), frame.control_point_normals.size(),
                                   organ_names.size()));
}

std::vector<std::pair<std::string, std::string>> names_of(const std::vector<registration::ContactPair> &pairs,
                                                          const std::vector<registration::Body> &bodies)
{
  std::vector<std::pair<std::string, std::string>> names;
  for (const registration::ContactPair &pair : pairs)
    names.emplace_back(bodies[static_cast<std::size_t>(pair.body_a)].name,
                       bodies[static_cast<std::size_t>(pair.body_b)].name);
  return names;
}

double mean_of(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Times of no step yet, with a place for every phase.
dataset::StepTimes no_times()
{
  dataset::StepTimes times;
  for (const registration::StepPhase &phase : registration::step_phases)
    times.phases.emplace_back(phase.name);
  times.phase_ms.resize(times.phases.size());
  return times;
}

void add_step(double step_ms, const registration::PhaseTimes &phases, dataset::StepTimes &times)
{
  times.step_ms.push_back(step_ms);
  for (std::size_t k = 0; k < times.phase_ms.size(); ++k)
    times.phase_ms[k].push_back(phases.*registration::step_phases[k].time);
}

const dataset::RegistrationBody &organ_body(const dataset::RegistrationModel &model, const std::string &organ)
{
  return model.bodies[static_cast<std::size_t>(body_index(model, organ))];
}
} // namespace

std::vector<int> runs_of_shard(int samples, const Shard &shard)
{
  std::vector<int> numbers;
  for (int number = shard.index - 1; number <= samples; number += shard.n)
    numbers.push_back(number);
  return numbers;
}

std::string phase_title(const std::string &phase)
{
  const auto &phases = registration::step_phases;
  const auto known = std::find_if(phases.begin(), phases.end(),
                                  [&](const registration::StepPhase &other) { return other.name == phase; });
  return known == phases.end() ? phase : known->title;
}

StepTiming timing_of(const std::string &label, const dataset::StepTimes &times)
{
  std::vector<double> sorted = times.step_ms;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double fraction)
  { return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))]; };
  StepTiming timing{label, static_cast<int>(sorted.size()), at(0.5), at(0.95), sorted.back(), mean_of(times.step_ms)};
  for (std::size_t k = 0; k < times.phases.size(); ++k)
    timing.phases.push_back({times.phases[k], mean_of(times.phase_ms[k])});
  return timing;
}

RegistrationRuns::RegistrationRuns(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                                   const std::string &condition, const dataset::Perturbation &perturbation)
    : condition_(condition), model_(anatomy.registration), observations_(observations),
      steps_per_increment_(anatomy.registration_steps_per_increment)
{
  require_known_condition(condition);
  runner::require_usable(perturbation);
  require_usable(anatomy, observations);
  options_ = options_of(condition, anatomy);
  description_.case_name = anatomy.case_name;
  description_.condition = condition;
  description_.perturbation = perturbation;
  const registration::Model nominal = convert(model_of_run(0));
  if (options_.use_contact)
    description_.contact_pairs = names_of(nominal.contact_pairs, nominal.bodies);
  for (const std::string &organ : organ_names)
    rest_surfaces_.push_back({organ, outer_surface(organ_body(model_, organ)).rest, {}});
}

void RegistrationRuns::mutate(const registration::Mutation &mutation)
{
  options_.mutation = mutation;
}

/// Numbers are drawn for the bodies of the whole model, so that a body is the same in every condition.
dataset::RegistrationModel RegistrationRuns::model_of_run(int sample) const
{
  return model_of(condition_, perturbed(model_, description_.perturbation, sample));
}

dataset::EstimateSample RegistrationRuns::play(int sample, dataset::StepTimes &times,
                                               const std::function<void()> &step_done) const
{
  times = no_times();
  const dataset::RegistrationModel model = model_of_run(sample);
  const dataset::Observations observations = perturbed(observations_, description_.perturbation, sample);
  dataset::EstimateSample run;
  run.sample = sample;
  std::vector<OuterSurface> surfaces;
  for (const std::string &organ : organ_names)
  {
    surfaces.push_back(outer_surface(organ_body(model, organ)));
    run.surfaces.push_back({organ, surfaces.back().rest, {}});
  }

  registration::Registration registration;
  try
  {
    registration.prepare(convert(model), options_);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(fmt::format("register, condition '{}', run {}: the registration refuses the model: {}", condition_,
                                 sample, error.what()));
  }
  for (const dataset::DynamicFrame &frame : observations.frames)
  {
    const registration::Observation observation = convert(frame, observations.dyn_plane, model);
    for (int repetition = 0; repetition < steps_per_increment_; ++repetition)
    {
      const auto start = std::chrono::steady_clock::now();
      const registration::StepSummary summary = registration.update(observation);
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
      add_step(elapsed.count(), registration.phase_times(), times);
      run.steps.push_back(convert(summary, registration.penetrations()));
      for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
        run.surfaces[organ].positions.push_back(
            surfaces[organ].pick(registration.positions(body_index(model, organ_names[organ]))));
      step_done();
    }
  }
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    run.bodies.push_back(
        {model.bodies[body].name, model.bodies[body].points, registration.positions(static_cast<int>(body))});
  return run;
}

void play_runs(const RegistrationRuns &runs, const std::vector<int> &numbers, const RunnerOptions &options,
               const RunDone &done)
{
  std::mutex progress_mutex, done_mutex;
  int n_done = 0;
  const int n_runs = static_cast<int>(numbers.size()), n_steps = n_runs * runs.n_steps();
  const auto step_done = [&]
  {
    const std::lock_guard lock(progress_mutex);
    ++n_done;
    if (options.progress)
      options.progress(static_cast<double>(n_done) / n_steps,
                       fmt::format("{}: step {} of {} ({} runs)", runs.description().label(), n_done, n_steps, n_runs));
  };
  dataset::for_each_index(n_runs, options.n_threads,
                          [&](int i)
                          {
                            dataset::StepTimes times;
                            const dataset::EstimateSample run =
                                runs.play(numbers[static_cast<std::size_t>(i)], times, step_done);
                            const std::lock_guard lock(done_mutex);
                            done(run, times);
                          });
}

dataset::Estimate run_registration(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                                   const std::string &condition, const RunnerOptions &options, StepTiming *timing)
{
  if (options.samples < 0 || options.n_threads < 1)
    throw InputError(fmt::format("register: got samples {}, threads {}; allowed are samples >= 0, threads >= 1",
                                 options.samples, options.n_threads));
  RegistrationRuns runs(anatomy, observations, condition, options.perturbation);
  if (options.mutation)
    runs.mutate(*options.mutation);
  dataset::Estimate estimate = runs.description();
  estimate.samples.resize(static_cast<std::size_t>(options.samples) + 1);
  play_runs(runs, runs_of_shard(options.samples, {}), options,
            [&](const dataset::EstimateSample &run, const dataset::StepTimes &times)
            {
              estimate.samples[static_cast<std::size_t>(run.sample)] = run;
              if (timing && run.sample == 0)
                *timing = timing_of(estimate.label(), times);
            });
  return estimate;
}
} // namespace pelvireg::runner
