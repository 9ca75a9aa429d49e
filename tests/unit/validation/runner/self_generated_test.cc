#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/evaluate.h"
#include "validation/runner/self_generated.h"

#include <gtest/gtest.h>

namespace pelvireg::runner
{
namespace
{
const Eigen::Vector3d motion(0, 3, -4);

TEST(SelfGenerated, TruthIsTheNominalRunAtTheLastStepOfEachIncrement)
{
  dataset::Estimate estimate = test::sphere_estimate("full", motion, 1);
  const dataset::Anatomy anatomy = test::sphere_anatomy();
  for (dataset::EstimateSurface &surface : estimate.samples.front().surfaces)
    for (std::size_t step = 0; step < surface.positions.size(); ++step)
      surface.positions[step].array() += 0.1 * static_cast<double>(step); // no two steps are the same
  const dataset::Truth truth = self_generated_truth(anatomy, estimate, "driver");
  const dataset::EstimateSample &run = estimate.samples.front();
  ASSERT_EQ(truth.surfaces.size(), run.surfaces.size());
  const int per_increment = anatomy.registration_steps_per_increment;
  for (std::size_t s = 0; s < run.surfaces.size(); ++s)
  {
    ASSERT_EQ(truth.surfaces[s].displacements.size(), static_cast<std::size_t>(anatomy.reference.n_increments));
    for (int k = 1; k <= anatomy.reference.n_increments; ++k)
      EXPECT_EQ(truth.surfaces[s].displacements[static_cast<std::size_t>(k) - 1],
                run.surfaces[s].positions[static_cast<std::size_t>(k * per_increment) - 1] -
                    run.surfaces[s].rest.points);
  }
  EXPECT_NE(truth.source.find("driver"), std::string::npos);
}

TEST(SelfGenerated, RunAgainstItsOwnTruthHasNoErrorAtTheEndAndIsCalledAnInverseCrime)
{
  const dataset::Estimate estimate = test::sphere_estimate("full", motion, 1);
  const dataset::Anatomy anatomy = test::sphere_anatomy();
  const Evaluation evaluation = evaluate(anatomy, self_generated_truth(anatomy, estimate, "driver"), {estimate});
  EXPECT_TRUE(evaluation.is_inverse_crime);
  EXPECT_NEAR(evaluation.reported_vaginal_displacement, evaluation.vaginal_displacement, 1e-12);
  int n_rows = 0;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == "full" && row.step == evaluation.n_steps())
    {
      EXPECT_NEAR(row.distance.max, 0, 1e-9) << row.organ;
      ++n_rows;
    }
  EXPECT_EQ(n_rows, 4);
}

TEST(SelfGenerated, RefusesARunWithAFailedStepWithoutNominalRunOrOfAnotherLength)
{
  const dataset::Estimate estimate = test::sphere_estimate("full", motion, 1);
  const dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Estimate failed = estimate, drawn = estimate;
  failed.samples.front().steps.back().status = "diverged";
  EXPECT_THROW(self_generated_truth(anatomy, failed, "driver"), InputError);
  drawn.samples.front().sample = 1;
  EXPECT_THROW(self_generated_truth(anatomy, drawn, "driver"), InputError);
  dataset::Anatomy longer = anatomy;
  ++longer.reference.n_increments;
  EXPECT_THROW(self_generated_truth(longer, estimate, "driver"), InputError);
}
} // namespace
} // namespace pelvireg::runner
