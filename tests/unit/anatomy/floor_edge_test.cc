// The pelvic floor's bony edge: sharp, or turned down over the bone with a radius.
#include "synthetic/dataset/error.h"
#include "tests/unit/anatomy/cases.h"

#include <Eigen/Dense>

#include <algorithm>
#include <set>

namespace pelvireg::test
{
namespace
{
using dataset::ReferenceShell;
using Eigen::RowVector3d;

/// The floor of `quick`, its edge turned over with a radius, mm.
ReferenceShell floor_with_edge(double radius)
{
  const std::string text =
      anatomy::with_value(anatomy::case_text("quick"), "quick", "pelvic_floor.edge_radius", std::to_string(radius));
  const dataset::Anatomy anatomy = anatomy::build_anatomy(text, "quick");
  return shell_of(anatomy, "pelvic_floor");
}

std::set<std::int32_t> held(const ReferenceShell &floor)
{
  return {floor.fixed_nodes.begin(), floor.fixed_nodes.end()};
}

TEST(FloorEdge, LeavesTheBowlAsItIs)
{
  const ReferenceShell sharp = floor_with_edge(0);
  const ReferenceShell turned = floor_with_edge(8);
  ASSERT_GT(turned.cells.rows(), sharp.cells.rows());
  for (Eigen::Index c = 0; c < sharp.cells.rows(); ++c)
    for (int k = 0; k < 9; ++k)
      EXPECT_TRUE(turned.midsurface.row(turned.cells(c, k)).isApprox(sharp.midsurface.row(sharp.cells(c, k)), 1e-12));
}

TEST(FloorEdge, TurnsWithTheStatedRadiusAndWithoutAKink)
{
  constexpr double radius = 8;
  const ReferenceShell sharp = floor_with_edge(0);
  const ReferenceShell turned = floor_with_edge(radius);
  // Every point of the turn is a radius along its normal from the axis that the edge point before it turns about.
  std::vector<RowVector3d> axes;
  for (const std::int32_t node : held(sharp))
    axes.push_back(sharp.midsurface.row(node) - radius * sharp.directors.row(node));
  double lowest = 1; // cosine between a normal and that of its edge point
  for (const std::int32_t node : held(turned))
  {
    const RowVector3d axis = turned.midsurface.row(node) - radius * turned.directors.row(node);
    const auto nearest = std::min_element(axes.begin(), axes.end(),
                                          [&](const RowVector3d &a, const RowVector3d &b)
                                          { return (a - axis).norm() < (b - axis).norm(); });
    EXPECT_LT((*nearest - axis).norm(), 1e-6) << node;
    EXPECT_NEAR(turned.directors.row(node).norm(), 1, 1e-12);
    const std::size_t edge = static_cast<std::size_t>(nearest - axes.begin());
    lowest = std::min(lowest, turned.directors.row(node).dot(
                                  sharp.directors.row(sharp.fixed_nodes[static_cast<Eigen::Index>(edge)])));
  }
  EXPECT_NEAR(lowest, 0, 1e-6) << "a quarter turn";
}

TEST(FloorEdge, IsHeldOnTheBoneAndNowhereElse)
{
  const ReferenceShell sharp = floor_with_edge(0);
  const ReferenceShell turned = floor_with_edge(8);
  const std::set<std::int32_t> fixed = held(turned);
  const auto is_held = [&](Eigen::Index c, int k) { return fixed.count(turned.cells(c, k)) == 1; };
  std::size_t held_in_bowl = 0;
  for (Eigen::Index c = 0; c < turned.cells.rows(); ++c)
    for (int k = 0; k < 9; ++k)
    {
      if (c >= sharp.cells.rows())
      {
        EXPECT_TRUE(is_held(c, k)) << "cell " << c << " lies on the bone";
        continue;
      }
      held_in_bowl += is_held(c, k);
      EXPECT_EQ(is_held(c, k), held(sharp).count(sharp.cells(c, k)) == 1) << "cell " << c;
    }
  EXPECT_GT(held_in_bowl, 0u);
}

TEST(FloorEdge, HasARadiusFromZeroOn)
{
  EXPECT_NO_THROW(floor_with_edge(0));
  EXPECT_NO_THROW(floor_with_edge(1e-3));
  EXPECT_THROW(floor_with_edge(-1e-3), InputError);
}
} // namespace
} // namespace pelvireg::test
