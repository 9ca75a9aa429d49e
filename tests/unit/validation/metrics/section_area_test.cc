#include "validation/metrics/section_area.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
TEST(SectionArea, OfABoxIsThatOfItsParallelogram)
{
  const dataset::SurfaceMesh box = test::box({-5, -10, -20}, {10, 20, 40});
  EXPECT_NEAR(section_area(box.points, box.triangles, {{1, 2, 3}, {1, 0, 0}}), 800, 1e-10);
  EXPECT_NEAR(section_area(box.points, box.triangles, {{1, 2, 3}, {-1, 0, 0}}), 800, 1e-10);
  const Eigen::Vector3d tilted = Eigen::Vector3d(4, 3, 0) / 5; // the cut through the long sides grows by 1 / cos
  EXPECT_NEAR(section_area(box.points, box.triangles, {{0, 0, 0}, tilted}), 10 * 5 / 3.0 * 40, 1e-10);
  EXPECT_EQ(section_area(box.points, box.triangles, {{6, 0, 0}, {1, 0, 0}}), 0);
}

TEST(SectionArea, OfASphereShrinksWithTheSquareOfTheDistance)
{
  const dataset::SurfaceMesh sphere = test::icosphere({3, 2, 1}, 20, 5);
  for (const double offset : {0.0, 10.0, 18.0, 19.5})
    EXPECT_NEAR(section_area(sphere.points, sphere.triangles, {{3 + offset, 0, 0}, {1, 0, 0}}),
                std::numbers::pi * (400 - offset * offset), 2.5)
        << offset;
}

TEST(SectionArea, TakesHolesAway)
{
  dataset::SurfaceMesh outer = test::icosphere({0, 0, 0}, 20, 4), hole = test::icosphere({0, 0, 3}, 10, 4);
  const dataset::Plane plane{{0.1, 0, 0}, {1, 0, 0}};
  const double expected =
      section_area(outer.points, outer.triangles, plane) - section_area(hole.points, hole.triangles, plane);
  hole.triangles.col(1).swap(hole.triangles.col(2));
  dataset::Points points(outer.points.rows() + hole.points.rows(), 3);
  points << outer.points, hole.points;
  dataset::Triangles triangles(outer.triangles.rows() + hole.triangles.rows(), 3);
  triangles << outer.triangles, (hole.triangles.array() + static_cast<std::int32_t>(outer.points.rows())).matrix();
  EXPECT_NEAR(section_area(points, triangles, plane), expected, 1e-9);
}

TEST(SectionArea, RefusesWhatHasNoAnswer)
{
  dataset::SurfaceMesh box = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(section_area(box.points, box.triangles, {{0, 0, 0}, {1, 1, 0}}), InputError);
  box.points(0, 0) = std::nan("");
  EXPECT_THROW(section_area(box.points, box.triangles, {{0, 0, 0}, {1, 0, 0}}), InputError);
}
} // namespace
} // namespace pelvireg::metrics
