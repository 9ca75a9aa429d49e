// Bars that hold an edge pull at it as a uniform pull does.
#include "synthetic/anatomy/bar_ends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace pelvireg::anatomy
{
namespace
{
/// Corner, middle, corner, …: points of a circle of radius 1 about the origin.
dataset::Points circle(int n_edges)
{
  dataset::Points points(2 * n_edges, 3);
  for (int i = 0; i < 2 * n_edges; ++i)
    points.row(i) << std::cos(std::numbers::pi * i / n_edges), std::sin(std::numbers::pi * i / n_edges), 0;
  return points;
}

dataset::Integers in_order(Eigen::Index n)
{
  return dataset::Integers::LinSpaced(n, 0, static_cast<std::int32_t>(n) - 1);
}

std::map<std::int32_t, double> pull_of_nodes(const std::vector<LoopPart> &parts)
{
  std::map<std::int32_t, double> pull;
  for (const LoopPart &part : parts)
    for (const auto &[node, share] : part.middle.nodes)
    {
      EXPECT_GT(share, 0);
      pull[node] += share * part.length;
    }
  return pull;
}

TEST(EqualParts, PullAtStraightEdgesAsTheQuadraticShapeFunctionsSay)
{
  // A triangle with sides 3, 4 and 5: int N ds is L/6 at a corner of an edge of length L, 4 L/6 in its middle.
  dataset::Points points(6, 3);
  points << 0, 0, 0, 1.5, 0, 0, 3, 0, 0, 1.5, 2, 0, 0, 4, 0, 0, 2, 0;
  const std::map<std::int32_t, double> pull = pull_of_nodes(equal_parts(points, in_order(6)));
  const double expected[6] = {(3 + 4) / 6., 2, (3 + 5) / 6., 10 / 3., (5 + 4) / 6., 8 / 3.};
  ASSERT_EQ(pull.size(), 6u);
  for (const auto &[node, value] : pull)
    EXPECT_NEAR(value, expected[node], 1e-12) << node;
}

TEST(EqualParts, LieOnTheQuadraticEdgesAndMeasureThem)
{
  // A quadratic edge is off the circle by at most h^3 / (9 sqrt(3)), h half an edge: 1.2e-3 for 12 edges.
  constexpr int n_edges = 12;
  double length = 0;
  for (const LoopPart &part : equal_parts(circle(n_edges), in_order(2 * n_edges)))
  {
    EXPECT_NEAR(part.middle.position.norm(), 1, 1.2e-3);
    length += part.length;
  }
  EXPECT_NEAR(length / (2 * std::numbers::pi), 1, 1e-3);
  EXPECT_GT(length, 2 * n_edges * 2 * std::sin(std::numbers::pi / n_edges / 2)) << "longer than the chords";
}
} // namespace
} // namespace pelvireg::anatomy
