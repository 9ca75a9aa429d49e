#include "validation/runner/evaluate.h"

#include "synthetic/dataset/error.h"
#include "tests/scratch_folder.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/result_files.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>

namespace pelvireg::runner
{
namespace
{
const Eigen::Vector3d translation(2, 3, -6);

Evaluation judged(const std::vector<dataset::Estimate> &estimates)
{
  return evaluate(test::sphere_anatomy(), test::sphere_truth(translation), estimates);
}

TEST(Evaluate, APerfectEstimateHasNoError)
{
  const Evaluation evaluation = judged({test::sphere_estimate("full", translation, 1.0)});
  int n_rows = 0;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == "full")
    {
      ++n_rows;
      EXPECT_LE(row.distance.max, 1e-12) << row.organ << " step " << row.step;
    }
  EXPECT_EQ(n_rows, 4 * 6);
  for (const SliceError &row : evaluation.by_slice)
    if (row.condition == "full")
    {
      EXPECT_LE(row.distance.max, 1e-12) << row.organ << " slice " << row.slice_index;
    }
}

TEST(Evaluate, UnregisteredIsAlwaysThereAndGrowsWithTheMotion)
{
  const Evaluation evaluation = judged({});
  ASSERT_EQ(evaluation.conditions, std::vector<std::string>{unregistered});
  ASSERT_EQ(evaluation.by_step.size(), 4u * 6u);
  for (std::size_t row = 2; row < 6; ++row)
    EXPECT_EQ(evaluation.by_step[row].distance.mean > evaluation.by_step[row - 1].distance.mean, row % 2 == 0)
        << "two steps share an increment, the next one is farther";
}

TEST(Evaluate, AnEstimateThatDoesNotMoveEqualsUnregistered)
{
  const Evaluation evaluation = judged({test::sphere_estimate("full", translation, 0.0)});
  for (std::size_t row = 0; row < 24; ++row)
    EXPECT_EQ(evaluation.by_step[row].distance.mean, evaluation.by_step[row + 24].distance.mean);
}

TEST(Evaluate, ReproducesTheMeanDistanceOfOffsetSpheres)
{
  // Mean over a sphere of the distance to the same sphere moved by d: exactly d / 2.
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Truth truth = test::sphere_truth({0, 4, 0});
  for (std::size_t organ = 0; organ < 4; ++organ)
  {
    const dataset::SurfaceMesh sphere = test::icosphere({0.37, 0, 100.0 * static_cast<double>(organ)}, 20, 3);
    truth.surfaces[organ].rest.points = sphere.points;
    anatomy.registration.bodies[organ].points.bottomRows(sphere.points.rows()) = sphere.points;
  }
  const Evaluation evaluation = evaluate(anatomy, truth, {});
  for (const StepError &row : evaluation.by_step)
    if (row.step == 6)
    {
      EXPECT_NEAR(row.distance.mean, 2.0, 0.06) << "201 samples: a stratified mean to 3 %";
    }
}

TEST(Evaluate, MeasuresTheTruthsMotionInAndOffThePlane)
{
  const Evaluation evaluation = judged({});
  ASSERT_EQ(evaluation.motion.size(), 4u);
  for (const OrganMotion &organ : evaluation.motion)
  {
    EXPECT_NEAR(organ.mean, 7, 1e-12);
    EXPECT_NEAR(organ.max_off_plane, 2, 1e-12);
  }
  EXPECT_NEAR(evaluation.vaginal_displacement, std::sqrt(45.0), 1e-12);
}

TEST(Evaluate, MeasuresWhatTheTwoMeshesDifferBeforeAnyMotion)
{
  EXPECT_LE(judged({}).motion[0].mesh_difference.max, 1e-12) << "the same mesh";
  dataset::Anatomy anatomy = test::sphere_anatomy();
  anatomy.registration.bodies[2].points.col(2).array() += 200; // far from every other organ
  const Evaluation evaluation = evaluate(anatomy, test::sphere_truth(translation), {});
  EXPECT_NEAR(evaluation.motion[2].mesh_difference.mean, 200 - 15, 7) << "to the lower pole of the moved ellipsoid";
  EXPECT_LE(evaluation.motion[3].mesh_difference.max, 1e-12);
}

TEST(Evaluate, SliceRowsExistExactlyWhereTheTruthIsCut)
{
  const Evaluation evaluation = judged({test::sphere_estimate("full", translation, 1.0)});
  // Truth at the last increment: centre 2.37, half axis 20, so slice -3 at -18 mm misses it and six others cut it.
  EXPECT_EQ(evaluation.by_slice.size() + evaluation.missed_slices.size(), 2u * 4u * 6u);
  for (const SliceError &row : evaluation.by_slice)
    EXPECT_EQ(row.offset, 6.0 * row.slice_index);
}

TEST(Evaluate, ASliceThatTheEstimateMissesIsCountedNotScored)
{
  // Truth moves 12 mm to the left: 12.37 + 20 > 30 = slice 5; the rest mesh ends at 20.37, short of slices 4 and 5.
  dataset::Anatomy anatomy = test::sphere_anatomy();
  anatomy.n_slices_each_side = 5;
  const Evaluation evaluation = evaluate(anatomy, test::sphere_truth({12, 0, 0}), {});
  ASSERT_EQ(evaluation.missed_slices.size(), 4u * 2u);
  for (const MissedSlice &slice : evaluation.missed_slices)
  {
    EXPECT_GE(slice.slice_index, 4);
    EXPECT_GT(slice.truth_length, 0);
  }
  for (const SliceError &row : evaluation.by_slice)
    EXPECT_LE(row.slice_index, 3);
}

TEST(Evaluate, KeepsWhatTheRunsSayOfThemselves)
{
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1.0);
  estimate.samples[0].steps[2].status = "not_finite";
  estimate.samples[0].steps[4].accepted_control_points = 10;
  const Evaluation evaluation = judged({estimate});
  ASSERT_EQ(evaluation.quality.size(), 1u);
  EXPECT_EQ(evaluation.quality[0].n_failed_steps, 1);
  EXPECT_DOUBLE_EQ(evaluation.quality[0].least_acceptance, 0.5);
  EXPECT_DOUBLE_EQ(evaluation.quality[0].largest_mean_residual, 0.06) << "step 6, the last of its position";
}

TEST(Evaluate, MeasuresHowDeepOrgansReachIntoEachOther)
{
  // At step 5 and 6 of 6 the uterus (centre 200 mm up) has been lost onto the vagina, 29 mm above its centre.
  dataset::Estimate estimate = test::sphere_estimate("full", translation, 1.0);
  for (const int step : {4, 5})
    estimate.samples[0].surfaces[2].positions[static_cast<std::size_t>(step)].col(2).array() -= 71;
  dataset::Anatomy anatomy = test::sphere_anatomy();
  anatomy.registration.attachments.push_back({"glue", "organ", "uterus", dataset::Integers(0), "rectum"});
  const Evaluation evaluation = evaluate(anatomy, test::sphere_truth(translation), {estimate});
  ASSERT_EQ(evaluation.penetrations.size(), 12u); // unregistered and full
  const int last_step = test::n_increments * test::steps_per_increment;
  for (const OrganPenetration &pair : evaluation.penetrations)
  {
    const bool is_lost = pair.condition == "full" && pair.organ_a == "vagina" && pair.organ_b == "uterus";
    EXPECT_NEAR(pair.deepest, is_lost && last_step >= 6 ? 1 : 0, 0.2) << pair.organ_a << pair.organ_b;
    EXPECT_EQ(pair.is_attached, pair.organ_a == "uterus" && pair.organ_b == "rectum");
  }
}

TEST(Evaluate, GivesTheSameBytesForOneAndTwoThreadsAndAnyOrderOfEstimates)
{
  const dataset::Estimate full = test::sphere_estimate("full", translation, 0.9);
  const dataset::Estimate bare = test::sphere_estimate("no_boundary_conditions", translation, 0.6);
  EvaluateOptions two_threads;
  two_threads.n_threads = 2;
  const Evaluation one = judged({full, bare});
  const Evaluation two = evaluate(test::sphere_anatomy(), test::sphere_truth(translation), {bare, full}, two_threads);
  EXPECT_EQ(errors_by_step_csv(one), errors_by_step_csv(two));
  EXPECT_EQ(errors_by_slice_csv(one), errors_by_slice_csv(two));
  EXPECT_EQ(metrics_by_step_csv(one), metrics_by_step_csv(two));
  EXPECT_EQ(errors_by_distance_csv(one), errors_by_distance_csv(two));
  EXPECT_EQ(one.conditions, (std::vector<std::string>{unregistered, "no_boundary_conditions", "full"}));
}

/// The nominal and four further runs, all different.
dataset::Estimate several_runs(const std::string &condition)
{
  dataset::Estimate estimate = test::sphere_estimate(condition, translation, 0.9);
  for (const int run : {1, 2, 3, 4})
  {
    estimate.samples.push_back(test::sphere_estimate(condition, translation, 0.9 - 0.1 * run).samples.front());
    estimate.samples.back().sample = run;
  }
  return estimate;
}

/// Every file that the judge writes.
std::vector<std::string> results_of(const Evaluation &evaluation)
{
  return {errors_by_step_csv(evaluation),     errors_by_slice_csv(evaluation), metrics_by_step_csv(evaluation),
          errors_by_distance_csv(evaluation), curves_by_step_csv(evaluation),  curves_by_slice_csv(evaluation),
          summary_json(evaluation, {})};
}

TEST(EvaluateRuns, ReadFromFilesOneByOneGivesTheSameBytesAsFromMemory)
{
  const test::ScratchFolder folder;
  const std::vector<dataset::Estimate> estimates = {several_runs("full"), several_runs("no_boundary_conditions")};
  std::vector<RunSource> sources;
  for (const dataset::Estimate &estimate : estimates)
  {
    dataset::save(estimate, folder / (estimate.label() + ".h5"));
    sources.push_back(runs_in(folder / (estimate.label() + ".h5")));
  }
  const auto at_once = results_of(judged(estimates));
  for (const int n_threads : {1, 2, 3})
    EXPECT_EQ(results_of(evaluate_runs(test::sphere_anatomy(), test::sphere_truth(translation), sources,
                                       {.n_threads = n_threads, .progress = {}})),
              at_once);
}

TEST(EvaluateRuns, AsksForEveryRunOnceAndHoldsOneAThread)
{
  const dataset::Estimate estimate = several_runs("full");
  for (const int n_threads : {1, 2})
  {
    std::atomic<int> n_asked{0}, n_held{0}, n_most{0};
    RunSource source = runs_of(estimate);
    source.run = [&](std::size_t i)
    {
      ++n_asked;
      const int held = ++n_held;
      int most = n_most;
      while (held > most && !n_most.compare_exchange_weak(most, held))
        ;
      return std::shared_ptr<const dataset::EstimateSample>(&estimate.samples[i],
                                                            [&](const dataset::EstimateSample *) { --n_held; });
    };
    evaluate_runs(test::sphere_anatomy(), test::sphere_truth(translation), {source},
                  {.n_threads = n_threads, .progress = {}});
    EXPECT_EQ(n_asked, 5);
    EXPECT_EQ(n_held, 0);
    EXPECT_LE(n_most, n_threads);
  }
}

TEST(EvaluateRuns, NamesTheFirstBrokenRunForEveryNumberOfThreads)
{
  dataset::Estimate estimate = several_runs("full");
  for (const std::size_t run : {2u, 4u})
    estimate.samples[run].surfaces[1].positions[3](7, 2) = std::nan("");
  for (const int n_threads : {1, 2, 4})
    try
    {
      evaluate(test::sphere_anatomy(), test::sphere_truth(translation), {estimate},
               {.n_threads = n_threads, .progress = {}});
      ADD_FAILURE() << "not refused";
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("'full', sample 2, vagina, step 4, node 7"), std::string::npos)
          << error.what();
    }
}
} // namespace
} // namespace pelvireg::runner
