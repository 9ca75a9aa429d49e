#include "registration/constraints/closest_point.h"
#include "registration/constraints/sliding.h"
#include "registration/constraints/triangle_tree.h"
#include "tests/unit/registration/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pelvireg::registration
{
namespace
{
Eigen::Vector3d random_vector(std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(random), uniform(random), uniform(random)};
}

/// A dense scan of the triangle: nothing shared with the code under test.
double scanned_distance(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                        const Eigen::Vector3d &c, int n)
{
  double least = 1e300;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, (a + (b - a) * i / n + (c - a) * j / n - p).norm());
  return least;
}
} // namespace

TEST(ClosestPoint, IsNoFartherThanAnyPointOfADenseScan)
{
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d a = random_vector(random), b = random_vector(random), c = random_vector(random),
                          p = 2 * random_vector(random);
    const TrianglePoint nearest = closest_point(p, a, b, c);
    const double scanned = scanned_distance(p, a, b, c, 100);
    EXPECT_LE(std::sqrt(nearest.squared_distance), scanned + 1e-12);
    EXPECT_GE(std::sqrt(nearest.squared_distance), scanned - 0.04); // a scan cell of edge <= 3.5 / 100
    EXPECT_GE(nearest.weights.minCoeff(), 0);
    EXPECT_NEAR(nearest.weights.sum(), 1, 1e-12);
  }
}

TEST(TriangleTree, FindsWhatAnExhaustiveSearchFindsAfterTheSurfaceMoved)
{
  const Body body = scene::hollow_ellipsoid({20, 30, 25}, 3, 3);
  Points positions = body.rest_positions;
  TriangleTree tree(body.outer_triangles, positions);
  positions = positions.unaryExpr([](double x) { return x + 2 * std::sin(x / 7); });
  tree.refit(positions);
  std::mt19937 random(5);
  const auto is_even = [](int t) { return t % 2 == 0; };
  for (int i = 0; i < 200; ++i)
  {
    const Eigen::Vector3d p = 35 * random_vector(random);
    NearestTriangle expected;
    expected.point.squared_distance = 400;
    for (int t = 0; t < body.outer_triangles.rows(); t += 2)
    {
      const auto corner = [&](int k) -> Eigen::Vector3d { return positions.row(body.outer_triangles(t, k)); };
      const TrianglePoint candidate = closest_point(p, corner(0), corner(1), corner(2));
      if (candidate.squared_distance < expected.point.squared_distance)
        expected = {t, candidate};
    }
    const NearestTriangle found = tree.nearest(p, 20, positions, is_even);
    EXPECT_EQ(found.triangle, expected.triangle);
    EXPECT_EQ(found.point.squared_distance, expected.point.squared_distance);
  }
}

TEST(TriangleTree, PrefersTheLowestIndexAmongEquallyNearTriangles)
{
  const Body body = scene::hollow_ellipsoid({10, 10, 10}, 2, 2);
  const TriangleTree tree(body.outer_triangles, body.rest_positions);
  const int vertex = 3;
  int lowest = -1;
  for (int t = 0; t < body.outer_triangles.rows() && lowest < 0; ++t)
    if ((body.outer_triangles.row(t).array() == vertex).any())
      lowest = t;
  const Eigen::Vector3d outside = 1.5 * body.rest_positions.row(vertex).transpose();
  EXPECT_EQ(tree.nearest(outside, 100, body.rest_positions, [](int) { return true; }).triangle, lowest);
}

TEST(Sliding, DirectionIsUnitAndLiesInTheImagePlane)
{
  const Body body = scene::hollow_ellipsoid({20, 30, 25}, 3, 3);
  const TriangleTree tree(body.outer_triangles, body.rest_positions);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 0.2, -0.1).normalized();
  const OutlineObservation outline = scene::outline(body, 0, body.rest_positions, {1, 0, 0}, normal);
  for (Eigen::Index k = 0; k < outline.points.rows(); ++k)
  {
    const SlidingMatch match = match_control_point(tree, body.rest_positions, outline.points.row(k),
                                                   outline.normals.row(k), normal, Options());
    ASSERT_TRUE(match.is_accepted);
    EXPECT_NEAR(match.direction.norm(), 1, 1e-14);
    EXPECT_NEAR(match.direction.dot(normal), 0, 1e-16 * 10);
    EXPECT_NEAR(match.gap, 0, 1e-12); // the points lie on the surface
  }
}

TEST(Sliding, RefusesAPointWhoseNearestCompatibleTriangleIsTooFar)
{
  const Body body = scene::block({40, 40, 4}, {4, 4, 1}, true, true);
  const TriangleTree tree(body.outer_triangles, body.rest_positions);
  Options options;
  options.max_match_distance = 5;
  const auto is_accepted = [&](double height)
  {
    return match_control_point(tree, body.rest_positions, {20, 20, height}, Eigen::Vector3d::UnitZ(),
                               Eigen::Vector3d::UnitX(), options)
        .is_accepted;
  };
  EXPECT_TRUE(is_accepted(9 - 1e-12));
  EXPECT_FALSE(is_accepted(9 + 1e-12));
}

TEST(Sliding, RefusesTrianglesParallelToTheImagePlane)
{
  const Body body = scene::block({40, 40, 4}, {4, 4, 1}, true, true);
  const TriangleTree tree(body.outer_triangles, body.rest_positions);
  const SlidingMatch match = match_control_point(tree, body.rest_positions, {20, 20, 4.1}, Eigen::Vector3d::UnitX(),
                                                 Eigen::Vector3d::UnitZ(), Options());
  ASSERT_TRUE(match.is_accepted); // on the side x = 40, not on the nearer top
  EXPECT_NEAR(match.gap, -20, 1e-12);
}

TEST(Sliding, MatchesTheWallThatFacesTheSameWayAndNotTheNearerOne)
{
  // A slab 4 mm thick: the outline of its top wall has moved down by 3 mm and lies 1 mm above the bottom wall.
  const Body body = scene::block({40, 40, 4}, {4, 4, 1}, true, true);
  const TriangleTree tree(body.outer_triangles, body.rest_positions);
  const SlidingMatch match = match_control_point(tree, body.rest_positions, {20, 20, 1}, Eigen::Vector3d::UnitZ(),
                                                 Eigen::Vector3d::UnitX(), Options());
  ASSERT_TRUE(match.is_accepted);
  EXPECT_NEAR(match.gap, -3, 1e-12);
  EXPECT_NEAR(match.direction.z(), 1, 1e-12);
}
} // namespace pelvireg::registration
