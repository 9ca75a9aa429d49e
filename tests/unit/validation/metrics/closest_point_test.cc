#include "validation/metrics/closest_point.h"

#include <gtest/gtest.h>

namespace pelvireg::metrics
{
namespace
{
using Eigen::Vector3d;

const Vector3d a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);

Vector3d closest(const Vector3d &p)
{
  return closest_point_on_triangle(p, a, b, c);
}

TEST(ClosestPointOnTriangle, AboveTheInteriorIsTheFoot)
{
  EXPECT_LE((closest({1, 1, 5}) - Vector3d(1, 1, 0)).norm(), 1e-15);
}

TEST(ClosestPointOnTriangle, BeyondEachEdgeLiesOnThatEdge)
{
  EXPECT_LE((closest({2, -1, 1}) - Vector3d(2, 0, 0)).norm(), 1e-15);
  EXPECT_LE((closest({-2, 1, 1}) - Vector3d(0, 1, 0)).norm(), 1e-15);
  // Foot of (4, 3) on the line 3x + 4y = 12: (4, 3) - 12/25 (3, 4).
  EXPECT_LE((closest({4, 3, 1}) - Vector3d(2.56, 1.08, 0)).norm(), 1e-14);
}

TEST(ClosestPointOnTriangle, BeyondEachCornerIsThatCorner)
{
  EXPECT_EQ(closest({-1, -1, 2}), a);
  EXPECT_EQ(closest({9, -1, 2}), b);
  EXPECT_EQ(closest({-1, 9, 2}), c);
}

TEST(ClosestPointOnTriangle, AcrossTheBorderOfEveryRegionThereIsNoJump)
{
  const double e = 1e-12;
  for (const auto &[inside, outside] : {std::pair<Vector3d, Vector3d>{{1, e, 1}, {1, -e, 1}},
                                        {{e, 1, 1}, {-e, 1, 1}},
                                        {{2 - e, 1.5 - e, 1}, {2 + e, 1.5 + e, 1}},
                                        {{e, e, 1}, {-e, -e, 1}},
                                        {{4 - e, 0, 1}, {4 + e, -e, 1}},
                                        {{0, 3 - e, 1}, {-e, 3 + e, 1}}})
  {
    EXPECT_LE((closest(inside) - closest(outside)).norm(), 4e-12);
    EXPECT_NEAR((closest(inside) - inside).norm(), 1, 1e-11);
    EXPECT_NEAR((closest(outside) - outside).norm(), 1, 1e-11);
  }
}

TEST(ClosestPointOnTriangle, DoesNotDependOnTheOrderOfTheCorners)
{
  for (const Vector3d &p : {Vector3d(1, 1, 5), Vector3d(4, 3, 1), Vector3d(-1, -1, 2), Vector3d(2, -1, 1)})
  {
    EXPECT_LE((closest_point_on_triangle(p, b, c, a) - closest(p)).norm(), 1e-14);
    EXPECT_LE((closest_point_on_triangle(p, a, c, b) - closest(p)).norm(), 1e-14);
  }
}

TEST(ClosestPointOnTriangle, WithoutAreaIsItsLongestEdge)
{
  EXPECT_EQ(closest_point_on_triangle({1, 2, 0}, a, b, {2, 0, 0}), Vector3d(1, 0, 0));
  EXPECT_EQ(closest_point_on_triangle({1, 2, 0}, b, b, b), b);
}

TEST(ClosestPointOnSegment, IsClampedToTheEnds)
{
  EXPECT_EQ(closest_point_on_segment({-1e-12, 1, 0}, a, b), a);
  EXPECT_EQ(closest_point_on_segment({4 + 1e-12, 1, 0}, a, b), b);
  EXPECT_EQ(closest_point_on_segment({3, 1, 0}, a, b), Vector3d(3, 0, 0));
  EXPECT_EQ(closest_point_on_segment({3, 1, 0}, b, b), b);
}
} // namespace
} // namespace pelvireg::metrics
