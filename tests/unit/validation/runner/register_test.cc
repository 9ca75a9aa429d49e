#include "validation/runner/register.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/outer_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::runner
{
namespace
{
dataset::Observations one_frame()
{
  dataset::Observations observations;
  observations.case_name = "spheres";
  dataset::DynamicFrame frame;
  frame.increment = 1;
  frame.control_points.assign(4, dataset::Points(0, 3));
  frame.control_point_normals.assign(4, dataset::Points(0, 3));
  observations.frames.push_back(frame);
  return observations;
}

void expect_refusal(const dataset::Observations &observations, const std::string &condition,
                    const RunnerOptions &options, const std::string &words)
{
  try
  {
    run_registration(test::sphere_anatomy(), observations, condition, options);
    FAIL() << "no refusal: " << words;
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

/// A cube of `size` mm, n^3 cells of six tetrahedra each (Kuhn), with its boundary as outer surface.
dataset::RegistrationBody cube(const std::string &name, const Eigen::Vector3d &corner, double size, int n)
{
  dataset::RegistrationBody body;
  body.name = name;
  body.youngs_modulus = 0.5;
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  body.points.resize((n + 1) * (n + 1) * (n + 1), 3);
  std::vector<std::array<int, 4>> tets;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
      {
        body.points.row(node(i, j, k)) = corner + size / n * Eigen::Vector3d(i, j, k);
        if (i == n || j == n || k == n)
          continue;
        const std::array<std::array<int, 3>, 6> orders = {
            {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
        for (std::size_t order = 0; order < 6; ++order)
        {
          std::array<int, 3> at = {i, j, k};
          std::array<int, 4> tet = {node(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step)
          {
            ++at[static_cast<std::size_t>(orders[order][step])];
            tet[step + 1] = node(at[0], at[1], at[2]);
          }
          if (order >= 3) // odd permutations are inverted
            std::swap(tet[2], tet[3]);
          tets.push_back(tet);
        }
      }
  body.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
  std::map<std::set<int>, std::vector<std::array<int, 3>>> faces;
  for (std::size_t t = 0; t < tets.size(); ++t)
  {
    const auto &[a, b, c, d] = tets[t];
    body.tets.row(static_cast<Eigen::Index>(t)) << a, b, c, d;
    for (const std::array<int, 3> &face : {std::array{a, c, b}, {a, b, d}, {b, c, d}, {a, d, c}})
      faces[{face[0], face[1], face[2]}].push_back(face);
  }
  std::vector<std::array<int, 3>> boundary;
  for (const auto &[nodes, uses] : faces)
    if (uses.size() == 1)
      boundary.push_back(uses.front());
  body.outer_triangles.resize(static_cast<Eigen::Index>(boundary.size()), 3);
  for (std::size_t t = 0; t < boundary.size(); ++t)
    body.outer_triangles.row(static_cast<Eigen::Index>(t)) << boundary[t][0], boundary[t][1], boundary[t][2];
  body.outer_region = dataset::Integers::Zero(body.outer_triangles.rows());
  return body;
}

/// Four cubes cut in the middle by the plane x = 0; one frame that moves each outline by 1 mm in +y.
dataset::Anatomy cube_anatomy()
{
  dataset::Anatomy anatomy;
  anatomy.case_name = "spheres";
  anatomy.registration_steps_per_increment = 3;
  anatomy.registration_friction = 0.1;
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
    anatomy.registration.bodies.push_back(
        cube(dataset::organ_names[organ], {-11, 0, 40.0 * static_cast<double>(organ)}, 20, 3));
  // A support of the vagina's far end, so that its moduli matter: a second body held on the first.
  dataset::RegistrationBody support = cube("ligaments", {-11, 20, 40}, 10, 2);
  for (int node = 0; node < support.points.rows(); ++node)
    if (support.points(node, 1) > 29.9)
    {
      support.fixed_nodes.conservativeResize(support.fixed_nodes.size() + 1);
      support.fixed_nodes[support.fixed_nodes.size() - 1] = node;
    }
  dataset::RegistrationAttachment hold{"cardinal", "ligament", "ligaments", {}, "vagina"};
  for (int node = 0; node < support.points.rows(); ++node)
    if (support.points(node, 1) < 20.1)
    {
      hold.nodes_a.conservativeResize(hold.nodes_a.size() + 1);
      hold.nodes_a[hold.nodes_a.size() - 1] = node;
    }
  support.outer_triangles.resize(0, 3);
  support.outer_region.resize(0);
  anatomy.registration.bodies.push_back(support);
  anatomy.registration.attachments.push_back(hold);
  return anatomy;
}

dataset::Observations cube_observations()
{
  dataset::Observations observations = one_frame();
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
  {
    const double z = 40.0 * static_cast<double>(organ);
    dataset::Points points(8, 3), normals(8, 3);
    points << 0, 1, z + 6, 0, 1, z + 14, 0, 21, z + 6, 0, 21, z + 14, 0, 7, z, 0, 15, z, 0, 7, z + 20, 0, 15, z + 20;
    normals << 0, -1, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, -1, 0, 0, -1, 0, 0, 1, 0, 0, 1;
    observations.frames[0].control_points[organ] = points;
    observations.frames[0].control_point_normals[organ] = normals;
  }
  return observations;
}

dataset::Estimate run_cubes(const std::string &condition, int samples, int n_threads)
{
  RunnerOptions options;
  options.samples = samples;
  options.n_threads = n_threads;
  return run_registration(cube_anatomy(), cube_observations(), condition, options);
}

double mean_motion(const dataset::EstimateSurface &surface)
{
  return (surface.positions.back() - surface.rest.points).col(1).mean();
}

TEST(RunRegistration, PlaysEachPositionThreeTimesAndFollowsTheOutline)
{
  const dataset::Estimate estimate = run_cubes("full", 0, 1);
  ASSERT_EQ(estimate.samples.size(), 1u);
  const dataset::EstimateSample &run = estimate.samples[0];
  ASSERT_EQ(run.steps.size(), 3u);
  for (const dataset::StepRecord &step : run.steps)
  {
    EXPECT_EQ(step.status, "ok");
    EXPECT_EQ(step.offered_control_points, 32);
    EXPECT_EQ(step.accepted_control_points, 32);
  }
  for (const dataset::EstimateSurface &surface : run.surfaces)
  {
    ASSERT_EQ(surface.positions.size(), 3u);
    EXPECT_NEAR(mean_motion(surface), 1.0, surface.name == "vagina" ? 0.5 : 0.1) << surface.name;
  }
}

TEST(RunRegistration, KeepsEveryNodeOfEveryBodyAtTheLastStep)
{
  const dataset::EstimateSample run = run_cubes("full", 0, 1).samples[0];
  const dataset::Anatomy anatomy = cube_anatomy();
  ASSERT_EQ(run.bodies.size(), anatomy.registration.bodies.size());
  for (std::size_t body = 0; body < run.bodies.size(); ++body)
  {
    EXPECT_EQ(run.bodies[body].name, anatomy.registration.bodies[body].name);
    EXPECT_EQ(run.bodies[body].rest, anatomy.registration.bodies[body].points);
    if (body < run.surfaces.size())
    {
      EXPECT_EQ(outer_surface(anatomy.registration.bodies[body]).pick(run.bodies[body].last),
                run.surfaces[body].positions.back());
    }
  }
}

/// Of the vagina's corner at x = -11, 11 mm off the image plane, a node of the patch that the support holds.
double corner_motion(const std::string &condition)
{
  const dataset::EstimateSurface vagina = run_cubes(condition, 0, 1).samples[0].surfaces[1];
  for (Eigen::Index node = 0; node < vagina.rest.points.rows(); ++node)
    if ((vagina.rest.points.row(node) - Eigen::RowVector3d(-11, 20, 40)).norm() < 1e-9)
      return vagina.positions.back()(node, 1) - 20;
  return std::nan("");
}

TEST(RunRegistration, WithoutBoundaryConditionsTheSupportDoesNotHold)
{
  EXPECT_LT(corner_motion("full"), 0.8 * corner_motion("no_boundary_conditions"));
}

TEST(RunRegistration, WithoutLigamentsTheSupportDoesNotHoldEither)
{
  // It is all that holds these cubes, which are too far apart to touch.
  EXPECT_NEAR(corner_motion("no_ligaments"), corner_motion("no_boundary_conditions"), 1e-6);
}

TEST(RunRegistration, KeepsOrgansApartUnlessTheConditionHasNoContact)
{
  // The uterus lies 0.1 mm above the vagina, and its outline goes down by 1 mm: outlines and contact contradict each
  // other, and the organs tilt. The depth is bounded as in a case, by 0.5 mm; without contact it would be 0.9 mm.
  dataset::Anatomy anatomy = cube_anatomy();
  anatomy.registration.bodies[2].points.col(2).array() -= 19.9;
  dataset::Observations observations = cube_observations();
  observations.frames[0].control_points[2].col(2).array() -= 20.9;
  const auto run = [&](const std::string &condition) { return run_registration(anatomy, observations, condition, {}); };
  const auto overlap = [](const dataset::Estimate &estimate)
  {
    const std::vector<dataset::EstimateSurface> &organs = estimate.samples[0].surfaces;
    return organs[1].positions.back().col(2).maxCoeff() - organs[2].positions.back().col(2).minCoeff();
  };
  for (const std::string condition : {"full", "no_friction"})
  {
    const dataset::Estimate estimate = run(condition);
    ASSERT_EQ(estimate.contact_pairs.size(), 6u);
    EXPECT_EQ(estimate.contact_pairs[3], std::pair(std::string("vagina"), std::string("uterus")));
    const dataset::StepRecord &last = estimate.samples[0].steps.back();
    ASSERT_EQ(last.penetration_depth.size(), 6u);
    EXPECT_GT(last.contacts, 0);
    EXPECT_GT(last.contact_force, 0.1);
    EXPECT_LE(last.penetration_depth[3], 0.5);
  }
  for (const std::string condition : {"no_contact", "no_boundary_conditions"})
  {
    const dataset::Estimate estimate = run(condition);
    EXPECT_TRUE(estimate.contact_pairs.empty());
    EXPECT_EQ(estimate.samples[0].steps.back().contacts, 0);
    EXPECT_GT(overlap(estimate), 0.6);
  }
  EXPECT_NE(run("full").samples[0].surfaces[1].positions.back(),
            run("no_friction").samples[0].surfaces[1].positions.back());
}

TEST(RunRegistration, GivesTheSameBitsForOneAndTwoThreadsAndAnyNumberOfSamples)
{
  const dataset::Estimate one = run_cubes("full", 3, 1), two = run_cubes("full", 3, 2), fewer = run_cubes("full", 1, 1);
  ASSERT_EQ(one.samples.size(), 4u);
  for (std::size_t sample = 0; sample < 4; ++sample)
    for (std::size_t organ = 0; organ < 4; ++organ)
    {
      EXPECT_EQ(one.samples[sample].sample, static_cast<int>(sample));
      EXPECT_EQ(one.samples[sample].surfaces[organ].positions, two.samples[sample].surfaces[organ].positions);
    }
  EXPECT_EQ(one.samples[1].surfaces[1].positions, fewer.samples[1].surfaces[1].positions);
}

TEST(RunRegistration, RandomisedRunsDifferFromTheNominalOneAndFromEachOther)
{
  const dataset::Estimate estimate = run_cubes("full", 2, 1);
  for (const auto &[a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
    EXPECT_NE(estimate.samples[a].surfaces[1].positions.back(), estimate.samples[b].surfaces[1].positions.back());
}

TEST(RunRegistration, EveryPerturbationChangesRandomisedRunsAloneAndIsDrawnBySeedAndNumber)
{
  const auto run = [](const dataset::Perturbation &perturbation, int n)
  {
    RunnerOptions options;
    options.samples = n;
    options.perturbation = perturbation;
    return run_registration(cube_anatomy(), cube_observations(), "full", options);
  };
  const auto last = [](const dataset::Estimate &estimate, std::size_t sample)
  { return estimate.samples[sample].surfaces[1].positions.back(); };
  const dataset::Points nominal = last(run_cubes("full", 0, 1), 0);
  for (dataset::Perturbation perturbation :
       {dataset::Perturbation{.kind = "surface", .surface_sd = 0.3, .surface_correlation_length = 10},
        dataset::Perturbation{.kind = "outline", .outline_sd = 0.3},
        dataset::Perturbation{.kind = "plane", .plane_offset_sd = 0.5, .plane_tilt_sd = 0.02}})
  {
    const dataset::Estimate two = run(perturbation, 2), one = run(perturbation, 1);
    EXPECT_EQ(two.label(), "full_" + perturbation.kind);
    EXPECT_EQ(last(two, 0), nominal) << perturbation.kind;
    EXPECT_EQ(last(two, 1), last(one, 1)) << perturbation.kind;
    EXPECT_NE(last(two, 1), nominal) << perturbation.kind;
    EXPECT_NE(last(two, 1), last(two, 2)) << perturbation.kind;
    EXPECT_LE((last(two, 1) - nominal).rowwise().norm().maxCoeff(), 3) << perturbation.kind;
    const bool has_own_rest = two.samples[1].surfaces[1].rest.points != two.samples[0].surfaces[1].rest.points;
    EXPECT_EQ(has_own_rest, perturbation.kind == "surface");
    for (const dataset::StepRecord &step : two.samples[1].steps)
      EXPECT_EQ(step.status, "ok");
    perturbation.seed = 2;
    EXPECT_NE(last(run(perturbation, 1), 1), last(two, 1)) << perturbation.kind;
  }
}

TEST(RunRegistration, SaysWhatTheRegistrationRefuses)
{
  dataset::Anatomy anatomy = cube_anatomy();
  anatomy.registration.bodies[2].youngs_modulus = 0;
  try
  {
    run_registration(anatomy, cube_observations(), "full", {});
    FAIL() << "no refusal";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("uterus"), std::string::npos) << error.what();
  }
}

TEST(RunRegistration, TimesTheNominalRunAndReportsProgress)
{
  StepTiming timing;
  RunnerOptions options;
  double last = 0;
  int n_calls = 0;
  options.progress = [&](double fraction, const std::string &)
  {
    EXPECT_GT(fraction, last);
    last = fraction;
    ++n_calls;
  };
  run_registration(cube_anatomy(), cube_observations(), "full", options, &timing);
  EXPECT_EQ(n_calls, 3);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(timing.condition, "full");
  EXPECT_EQ(timing.n_steps, 3);
  EXPECT_GT(timing.median_ms, 0);
  EXPECT_LE(timing.median_ms, timing.max_ms);
  ASSERT_EQ(timing.phases.size(), registration::step_phases.size());
  double sum = 0;
  for (std::size_t k = 0; k < timing.phases.size(); ++k)
  {
    EXPECT_EQ(timing.phases[k].name, registration::step_phases[k].name);
    sum += timing.phases[k].mean_ms;
  }
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, timing.mean_ms);
  EXPECT_LE(timing.mean_ms, timing.max_ms);
}

TEST(StepTiming, IsTheMedianOfTheStepsAndTheMeanOfEveryPhase)
{
  const StepTiming timing =
      timing_of("full", {.step_ms = {6, 1, 2}, .phases = {"match", "solve"}, .phase_ms = {{3, 0.5, 1}, {2, 0.5, 0.5}}});
  EXPECT_EQ(timing.n_steps, 3);
  EXPECT_EQ(timing.median_ms, 2);
  EXPECT_EQ(timing.max_ms, 6);
  EXPECT_EQ(timing.mean_ms, 3);
  ASSERT_EQ(timing.phases.size(), 2u);
  EXPECT_EQ(timing.phases[0].name, "match");
  EXPECT_EQ(timing.phases[0].mean_ms, 1.5);
  EXPECT_EQ(timing.phases[1].mean_ms, 1);
  EXPECT_EQ(phase_title("solve"), "constraint forces");
  EXPECT_EQ(phase_title("a later program's"), "a later program's");
}

TEST(RunRegistration, RefusesAnUnknownConditionAndNamesTheKnownOnes)
{
  expect_refusal(one_frame(), "no_gravity", {}, "'no_gravity' is unknown, allowed are: full, ");
  expect_refusal(one_frame(), "no_fascia", {}, "'no_fascia' has nothing to take away");
}

TEST(RunRegistration, RefusesOptionsOutOfRange)
{
  RunnerOptions options;
  options.samples = -1;
  expect_refusal(one_frame(), "full", options, "samples >= 0");
  options.samples = 0;
  for (const double spread : {1.0, -1e-12, std::nan("")})
  {
    options.perturbation.modulus_spread = spread;
    expect_refusal(one_frame(), "full", options, "must be at least 0 and below 1");
  }
}

TEST(RunRegistration, RefusesObservationsOfAnotherCaseAndIncompleteOnes)
{
  dataset::Observations observations = one_frame();
  observations.case_name = "cubes";
  expect_refusal(observations, "full", {}, "are of case 'cubes', the anatomy is 'spheres'");
  observations = one_frame();
  observations.frames.clear();
  expect_refusal(observations, "full", {}, "no frame");
  observations = one_frame();
  observations.frames[0].control_points.pop_back();
  expect_refusal(observations, "full", {}, "frame 1 has control points of 3 organs");
}
} // namespace
} // namespace pelvireg::runner
