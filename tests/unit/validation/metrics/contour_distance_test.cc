#include "validation/metrics/contour_distance.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
using dataset::Plane;
using dataset::SurfaceMesh;

const Plane midplane{{0.1, 0, 0}, {1, 0, 0}};

std::vector<CutSegment> cut(const SurfaceMesh &mesh)
{
  return cut_surface(mesh.points, mesh.triangles, mesh.region, midplane);
}

TEST(ContourDistance, OfConcentricCirclesIsTheDifferenceOfTheRadii)
{
  const auto truth = cut(test::icosphere({0.1, 0, 0}, 20, 5)), estimate = cut(test::icosphere({0.1, 0, 0}, 22, 5));
  const double edge = 22 * 1.2 / 32, sagitta = edge * edge / (2 * 22);
  for (const double distance : contour_distances(truth, estimate, 1.0))
    EXPECT_NEAR(distance, 2, sagitta);
}

TEST(ContourDistance, OfAParallelLineIsTheOffset)
{
  const auto truth = cut(test::square(50, 0, 7)), estimate = cut(test::square(50, -1.5, 4));
  const auto distances = contour_distances(truth, estimate, 1.0);
  EXPECT_EQ(distances.size(), 50u);
  for (const double distance : distances)
    EXPECT_NEAR(distance, 1.5, 1e-12);
}

TEST(ContourSamples, AreEvenInArcLengthWhateverTheSegments)
{
  const dataset::Points samples = sample_contour(cut(test::square(50, 0, 7)), 1.0);
  ASSERT_EQ(samples.rows(), 50);
  EXPECT_NEAR(samples.col(1).mean(), 25, 1e-12);
  EXPECT_NEAR(samples.col(1).minCoeff(), 0.5, 1e-12);
  EXPECT_NEAR(samples.col(1).maxCoeff(), 49.5, 1e-12);
}

TEST(ContourDistance, RefusesAnEmptyContourOnEitherSide)
{
  const auto truth = cut(test::square(50, 0, 7));
  EXPECT_THROW(contour_distances({}, truth, 1.0), InputError);
  EXPECT_THROW(contour_distances(truth, {}, 1.0), InputError);
  EXPECT_THROW(contour_distances(truth, truth, 0.0), InputError);
}
} // namespace
} // namespace pelvireg::metrics
