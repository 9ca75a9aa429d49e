#include "validation/runner/register.h"

#include "registration/registration.h"
#include "synthetic/dataset/error.h"
#include "validation/runner/outer_surface.h"
#include "validation/runner/parallel.h"
#include "validation/runner/perturbation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <stdexcept>

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

registration::Options options_of(const std::string &condition, const dataset::Anatomy &anatomy)
{
  registration::Options options;
  options.time_step = anatomy.registration_time_step;
  options.use_attachments = condition != "no_boundary_conditions";
  options.use_contact = condition != "no_boundary_conditions" && condition != "no_contact";
  if (condition == "no_friction")
    options.friction_coefficient = 0;
  return options;
}

void require_usable(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                    const std::string &condition, const RunnerOptions &options)
{
  const std::vector<std::string> known = condition_names();
  if (std::find(known.begin(), known.end(), condition) == known.end())
    throw InputError(
        fmt::format("register: condition '{}' is unknown, allowed are: {}", condition, fmt::join(known, ", ")));
  if (options.samples < 0 || !(options.spread >= 0 && options.spread < 1) || options.n_threads < 1)
    throw InputError(fmt::format("register: got samples {}, spread {}, threads {}; allowed are samples >= 0, "
                                 "0 <= spread < 1, threads >= 1",
                                 options.samples, options.spread, options.n_threads));
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

/// Everything that the runs share.
struct Setup
{
  registration::Model model;
  registration::Options options;
  std::vector<registration::Observation> observations; ///< one an increment
  std::vector<int> organ_bodies;                       ///< organ_names in order
  std::vector<OuterSurface> organ_surfaces;            ///< organ_names in order
  int steps_per_increment = 0;
};

Setup set_up(const dataset::Anatomy &anatomy, const dataset::Observations &observations, const std::string &condition)
{
  Setup setup;
  setup.model = convert(anatomy.registration);
  setup.options = options_of(condition, anatomy);
  for (const dataset::DynamicFrame &frame : observations.frames)
    setup.observations.push_back(convert(frame, observations.dyn_plane, anatomy.registration));
  for (const std::string &organ : organ_names)
  {
    setup.organ_bodies.push_back(body_index(anatomy.registration, organ));
    setup.organ_surfaces.push_back(
        outer_surface(anatomy.registration.bodies[static_cast<std::size_t>(setup.organ_bodies.back())]));
  }
  setup.steps_per_increment = anatomy.registration_steps_per_increment;
  return setup;
}

/// Play one run. step_ms receives the wall time of each step.
dataset::EstimateSample play(const Setup &setup, const registration::Model &model, int sample,
                             std::vector<double> &step_ms, const std::function<void()> &step_done)
{
  dataset::EstimateSample run;
  run.sample = sample;
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    run.surfaces.push_back({organ_names[organ], setup.organ_surfaces[organ].rest, {}});

  registration::Registration registration;
  registration.prepare(model, setup.options);
  for (const registration::Observation &observation : setup.observations)
    for (int repetition = 0; repetition < setup.steps_per_increment; ++repetition)
    {
      const auto start = std::chrono::steady_clock::now();
      const registration::StepSummary summary = registration.update(observation);
      step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      run.steps.push_back(convert(summary, registration.penetrations()));
      for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
        run.surfaces[organ].positions.push_back(
            setup.organ_surfaces[organ].pick(registration.positions(setup.organ_bodies[organ])));
      step_done();
    }
  return run;
}

registration::Model perturbed(registration::Model model, int sample, const RunnerOptions &options)
{
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    model.bodies[body].youngs_modulus *= modulus_factor(options.seed, sample, static_cast<int>(body), options.spread);
  return model;
}

StepTiming timing_of(const std::string &condition, std::vector<double> step_ms)
{
  std::sort(step_ms.begin(), step_ms.end());
  const auto at = [&](double fraction)
  { return step_ms[static_cast<std::size_t>(fraction * static_cast<double>(step_ms.size() - 1))]; };
  return {condition, static_cast<int>(step_ms.size()), at(0.5), at(0.95), step_ms.back()};
}
} // namespace

std::vector<std::string> condition_names()
{
  return {"full", "no_boundary_conditions", "no_contact", "no_friction"};
}

std::vector<std::string> default_conditions()
{
  return {"full", "no_boundary_conditions"};
}

dataset::Estimate run_registration(const dataset::Anatomy &anatomy, const dataset::Observations &observations,
                                   const std::string &condition, const RunnerOptions &options, StepTiming *timing)
{
  require_usable(anatomy, observations, condition, options);
  Setup setup = set_up(anatomy, observations, condition);
  if (options.mutation)
    setup.options.mutation = *options.mutation;
  const int n_runs = options.samples + 1;

  dataset::Estimate estimate;
  estimate.case_name = anatomy.case_name;
  estimate.condition = condition;
  if (setup.options.use_contact)
    for (const registration::ContactPair &pair : setup.model.contact_pairs)
      estimate.contact_pairs.emplace_back(setup.model.bodies[static_cast<std::size_t>(pair.body_a)].name,
                                          setup.model.bodies[static_cast<std::size_t>(pair.body_b)].name);
  estimate.samples.resize(static_cast<std::size_t>(n_runs));
  std::vector<std::vector<double>> step_ms(static_cast<std::size_t>(n_runs));
  std::mutex progress_mutex;
  int n_done = 0;
  const int n_steps = n_runs * static_cast<int>(setup.observations.size()) * setup.steps_per_increment;
  const auto step_done = [&]
  {
    const std::lock_guard lock(progress_mutex);
    ++n_done;
    if (options.progress)
      options.progress(static_cast<double>(n_done) / n_steps,
                       fmt::format("{}: step {} of {} ({} runs)", condition, n_done, n_steps, n_runs));
  };
  const auto run = [&](int sample)
  {
    const auto slot = static_cast<std::size_t>(sample);
    estimate.samples[slot] = play(setup, perturbed(setup.model, sample, options), sample, step_ms[slot], step_done);
  };
  try
  {
    for_each_index(n_runs, options.n_threads, run);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(
        fmt::format("register, condition '{}': the registration refuses the model: {}", condition, error.what()));
  }
  if (timing)
    *timing = timing_of(condition, step_ms.front());
  return estimate;
}
} // namespace pelvireg::runner
