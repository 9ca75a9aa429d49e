#include "validation/runner/register.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

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

TEST(RunRegistration, RefusesAnUnknownConditionAndNamesTheKnownOnes)
{
  expect_refusal(one_frame(), "no_gravity", {}, "'no_gravity' is unknown, allowed are: full, no_boundary_conditions");
}

TEST(RunRegistration, RefusesOptionsOutOfRange)
{
  RunnerOptions options;
  options.samples = -1;
  expect_refusal(one_frame(), "full", options, "samples >= 0");
  options.samples = 0;
  for (const double spread : {1.0, -1e-12, std::nan("")})
  {
    options.spread = spread;
    expect_refusal(one_frame(), "full", options, "0 <= spread < 1");
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
