// Whatever is missing, broken or of another case fails the evaluation with one clear sentence; it never gives a number.
#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/sphere_case.h"
#include "validation/runner/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace pelvireg::runner
{
namespace
{
const Eigen::Vector3d translation(2, 3, -6);

struct Inputs
{
  dataset::Anatomy anatomy = test::sphere_anatomy();
  dataset::Truth truth = test::sphere_truth(translation);
  std::vector<dataset::Estimate> estimates = {test::sphere_estimate("full", translation, 0.9)};
};

/// Break sound inputs and expect a refusal that says `words`.
void expect_failure(const std::function<void(Inputs &)> &break_inputs, const std::string &words)
{
  Inputs inputs;
  ASSERT_NO_THROW(evaluate(inputs.anatomy, inputs.truth, inputs.estimates)) << "the inputs were sound before";
  break_inputs(inputs);
  try
  {
    evaluate(inputs.anatomy, inputs.truth, inputs.estimates);
    FAIL() << "no failure, expected: " << words;
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Judge, RejectsAPositionThatIsNotFinite)
{
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
  {
    expect_failure([&](Inputs &in) { in.estimates[0].samples[0].surfaces[1].positions[3](7, 2) = value; },
                   "estimate 'full', sample 0, vagina, step 4, node 7");
    expect_failure([&](Inputs &in) { in.truth.surfaces[2].displacements[1](5, 0) = value; },
                   "the truth's uterus, step 2, node 5");
  }
}

TEST(Judge, RejectsAResidualThatIsNotFinite)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].steps[2].in_plane_residual = std::nan(""); },
                 "must be finite");
}

TEST(Judge, RejectsAMissingOrMisplacedOrgan)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces.pop_back(); }, "has 3 organs, must have 4");
  expect_failure([](Inputs &in)
                 { std::swap(in.estimates[0].samples[0].surfaces[0], in.estimates[0].samples[0].surfaces[1]); },
                 "organ 1 of estimate 'full', sample 0 is 'vagina', must be 'bladder'");
  expect_failure([](Inputs &in) { in.truth.surfaces.erase(in.truth.surfaces.begin() + 2); },
                 "the truth has no surface 'uterus'");
  expect_failure([](Inputs &in) { in.anatomy.registration.bodies.pop_back(); }, "body 'rectum' is missing");
}

TEST(Judge, RejectsAMissingStep)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces[3].positions.pop_back(); },
                 "rectum has 5 steps, must have 6");
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].steps.pop_back(); }, "has 5 step records, must have 6");
  expect_failure([](Inputs &in) { in.truth.surfaces[0].displacements.pop_back(); },
                 "the truth's bladder has 2 steps, must have 3");
}

TEST(Judge, RejectsAnotherCase)
{
  expect_failure([](Inputs &in) { in.estimates[0].case_name = "cubes"; }, "estimate 'full' is of case 'cubes'");
  expect_failure([](Inputs &in) { in.truth.case_name = "cubes"; }, "the truth is of case 'cubes'");
}

TEST(Judge, RejectsAStepWithOtherNodes)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces[0].positions[1].conservativeResize(100, 3); },
                 "bladder, step 2 has 100 nodes");
}

TEST(Judge, RejectsAnEmptySurfaceAndAnIndexOutOfRange)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces[0].rest.triangles.resize(0, 3); },
                 "bladder: surface: got no triangles");
  expect_failure([](Inputs &in) { in.truth.surfaces[1].rest.triangles(0, 0) = 100000; },
                 "the truth's vagina: surface: triangle indices");
}

TEST(Judge, RejectsAnOpenSurface)
{
  const auto open = [](dataset::SurfaceMesh &mesh)
  {
    mesh.triangles.conservativeResize(mesh.triangles.rows() - 1, 3);
    mesh.region.conservativeResize(mesh.region.size() - 1);
  };
  expect_failure([&](Inputs &in) { open(in.truth.surfaces[3].rest); }, "the truth's rectum: surface: it is open");
  expect_failure([&](Inputs &in) { open(in.estimates[0].samples[0].surfaces[0].rest); },
                 "bladder: surface: it is open");
}

TEST(Judge, RejectsAnOrganThatHasFlownApartAndNamesTheRun)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces[1].positions.back() *= 1e5; },
                 "evaluate: condition 'full', sample 0, step 6: volume in common");
}

TEST(Judge, RejectsElementsThatCannotBe)
{
  const auto with_elements = [](Inputs &in)
  {
    in.anatomy.registration.bodies[0].tets.resize(1, 4);
    in.anatomy.registration.bodies[0].tets << 0, 1, 2, 3;
    in.anatomy.registration.bodies[0].points.topRows(4) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    in.anatomy.registration.bodies[0].outer_triangles = test::sphere_anatomy().registration.bodies[0].outer_triangles;
    const dataset::Points nodes = in.anatomy.registration.bodies[0].points;
    in.estimates[0].samples[0].bodies = {{"bladder", nodes, nodes}};
  };
  expect_failure(
      [&](Inputs &in)
      {
        with_elements(in);
        in.estimates[0].samples[0].bodies[0].last(2, 1) = std::nan("");
      },
      "elements: got 643 nodes at rest and 643 deformed, must be as many and finite");
  expect_failure(
      [&](Inputs &in)
      {
        with_elements(in);
        in.estimates[0].samples[0].bodies[0].name = "spleen";
      },
      "body 'spleen' is missing");
}

TEST(Judge, RejectsAnEmptyContourInTheDynPlane)
{
  expect_failure([](Inputs &in) { in.estimates[0].samples[0].surfaces[2].positions.back().col(0).array() += 50; },
                 "the DYN plane misses the uterus of condition 'full', sample 0");
  expect_failure([](Inputs &in) { in.truth.surfaces[0].displacements.back().col(0).array() += 50; },
                 "the DYN plane misses the truth's bladder");
}

TEST(Judge, RejectsARunThatIsThereTwiceOrHasNoUsableName)
{
  expect_failure([](Inputs &in) { in.estimates.push_back(in.estimates.front()); }, "is there twice");
  expect_failure([](Inputs &in) { in.estimates[0].samples.clear(); }, "holds no run");
  for (const std::string name : {"", "unregistered", "full,0"})
    expect_failure([&](Inputs &in) { in.estimates[0].condition = name; }, "lower-case letters");
}

TEST(Judge, SeesAnEstimateThatIsTwiceAsWrong)
{
  const Inputs inputs;
  const auto error = [&](double share)
  {
    const Evaluation evaluation =
        evaluate(inputs.anatomy, inputs.truth, {test::sphere_estimate("full", translation, share)});
    return evaluation.by_step.back().distance.mean;
  };
  EXPECT_NEAR(error(0.8) / error(0.9), 2.0, 0.05);
}
} // namespace
} // namespace pelvireg::runner
