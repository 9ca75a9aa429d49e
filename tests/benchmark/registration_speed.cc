// Time of one registration step, whole and by phase, on the built-in cases. Build with PELVIREG_BENCHMARKS=ON and run
// with OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 in the environment.
#include "registration/registration.h"
#include "synthetic/anatomy/case.h"
#include "synthetic/observation/observe.h"
#include "validation/runner/outer_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg
{
namespace
{
constexpr int n_increments = 15, steps_per_increment = 3;

/// The organs pushed back and down by 7 mm at mid-height, less towards the ends: no reference is solved for a
/// benchmark.
dataset::Truth made_up_truth(const dataset::Anatomy &anatomy)
{
  dataset::Truth truth;
  truth.case_name = anatomy.case_name;
  truth.increments.resize(n_increments);
  for (const std::string &organ : dataset::organ_names)
  {
    const auto body = static_cast<std::size_t>(runner::body_index(anatomy.registration, organ));
    dataset::TruthSurface surface{organ, runner::outer_surface(anatomy.registration.bodies[body]).rest, {}};
    for (int increment = 1; increment <= n_increments; ++increment)
    {
      dataset::Points displacement = dataset::Points::Zero(surface.rest.points.rows(), 3);
      for (Eigen::Index i = 0; i < displacement.rows(); ++i)
      {
        const double height = (surface.rest.points(i, 2) - 45) / 40;
        displacement.row(i) = std::exp(-height * height) * increment / n_increments * Eigen::RowVector3d(0, 6, -3.6);
      }
      surface.displacements.push_back(displacement);
    }
    truth.surfaces.push_back(std::move(surface));
  }
  return truth;
}

registration::Model model_of(const dataset::RegistrationModel &model)
{
  registration::Model converted;
  for (const dataset::RegistrationBody &body : model.bodies)
  {
    registration::Body &to = converted.bodies.emplace_back();
    to.name = body.name;
    to.rest_positions = body.points;
    to.tets = body.tets;
    to.hexes = body.hexes;
    to.youngs_modulus = body.youngs_modulus;
    to.poisson_ratio = body.poisson_ratio;
    to.density = body.density;
    to.fixed_nodes.assign(body.fixed_nodes.begin(), body.fixed_nodes.end());
    to.outer_triangles = body.outer_triangles;
    for (const std::int32_t region : body.outer_region)
      to.is_wall.push_back(region != static_cast<std::int32_t>(dataset::SurfaceRegion::cap));
  }
  for (const dataset::RegistrationAttachment &a : model.attachments)
    converted.attachments.push_back({a.name,
                                     runner::body_index(model, a.body_a),
                                     {a.nodes_a.begin(), a.nodes_a.end()},
                                     runner::body_index(model, a.body_b),
                                     0});
  return converted;
}

std::vector<registration::Observation> observations_of(const dataset::Anatomy &anatomy)
{
  const dataset::Observations seen = observation::observe(anatomy, made_up_truth(anatomy));
  std::vector<registration::Observation> observations;
  for (const dataset::DynamicFrame &frame : seen.frames)
  {
    registration::Observation &to = observations.emplace_back();
    to.plane_origin = seen.dyn_plane.origin;
    to.plane_normal = seen.dyn_plane.normal;
    for (std::size_t k = 0; k < dataset::organ_names.size(); ++k)
      to.outlines.push_back({runner::body_index(anatomy.registration, dataset::organ_names[k]), frame.control_points[k],
                             frame.control_point_normals[k]});
  }
  return observations;
}

constexpr std::array<const char *, 5> columns = {"assemble", "factorise", "compliance", "solve", "step"};

/// Median over two plays of the motion, ms, in the order of `columns`.
std::array<double, 5> median_times(const dataset::Anatomy &anatomy, bool use_attachments, int n_threads)
{
  registration::Options options;
  options.time_step = anatomy.registration_time_step;
  options.use_attachments = use_attachments;
  options.n_threads = n_threads;
  registration::Registration registration;
  registration.prepare(model_of(anatomy.registration), options);
  std::array<std::vector<double>, 5> times;
  for (int play = 0; play < 2; ++play)
    for (const registration::Observation &observation : observations_of(anatomy))
      for (int step = 0; step < steps_per_increment; ++step)
      {
        if (registration.update(observation).status != registration::StepStatus::ok)
          throw std::runtime_error("a step failed in case " + anatomy.case_name);
        const registration::PhaseTimes &t = registration.phase_times();
        const double whole = t.match + t.assemble + t.factorise + t.free_motion + t.compliance + t.solve + t.correct;
        const std::array<double, 5> phases = {t.assemble, t.factorise, t.compliance, t.solve, whole + t.summarise};
        for (std::size_t k = 0; k < phases.size(); ++k)
          times[k].push_back(phases[k]);
      }
  std::array<double, 5> medians;
  for (std::size_t k = 0; k < times.size(); ++k)
  {
    const auto middle = times[k].begin() + static_cast<std::ptrdiff_t>(times[k].size() / 2);
    std::nth_element(times[k].begin(), middle, times[k].end());
    medians[k] = *middle;
  }
  return medians;
}
} // namespace
} // namespace pelvireg

int main()
{
  using namespace pelvireg;
  std::printf("%-42s", "median of a step, ms");
  for (const char *column : columns)
    std::printf("%12s", column);
  for (const std::string case_name : {"quick", "t005"})
  {
    const dataset::Anatomy anatomy = anatomy::build_anatomy(anatomy::case_text(case_name), case_name);
    for (const bool use_attachments : {false, true})
      for (const int n_threads : {1, 2})
      {
        const std::string condition = use_attachments ? "full" : "no_boundary_conditions";
        const std::string row = case_name + " " + condition + ", " + std::to_string(n_threads) + " threads";
        std::printf("\n%-42s", row.c_str());
        for (const double time : median_times(anatomy, use_attachments, n_threads))
          std::printf("%12.2f", time);
      }
  }
  std::printf("\n");
}
