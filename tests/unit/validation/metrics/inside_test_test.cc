#include "validation/metrics/inside_test.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/penetration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
TEST(InsideTest, AgreesWithTheSolidAngleOnAFoldedSurface)
{
  // A shell folded over by sine waves: up to six walls above a point.
  dataset::SurfaceMesh folded = test::ellipsoid({3, -5, 40}, {32, 24, 17}, 4);
  for (Eigen::Index i = 0; i < folded.points.rows(); ++i)
    folded.points(i, 2) += 12 * std::sin(0.4 * folded.points(i, 0));
  const InsideTest test(folded.points, folded.triangles);
  int n_inside = 0, n = 0;
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j)
      for (int k = -12; k <= 12; ++k)
      {
        const Eigen::Vector3d p(3.01 + 2.9 * i, -5.02 + 2.3 * j, 40.03 + 2.7 * k);
        const bool expected = is_inside(p, folded.points, folded.triangles);
        ASSERT_EQ(test.is_inside(p), expected) << p.transpose();
        n_inside += expected;
        ++n;
      }
  EXPECT_GT(n_inside, n / 20);
  EXPECT_LT(n_inside, n / 2);
}

TEST(InsideTest, CountsEdgesAndNodesOnItsWayOnce)
{
  const dataset::SurfaceMesh box = test::box({0, 0, 0}, {4, 4, 4});
  const InsideTest test(box.points, box.triangles);
  for (const Eigen::Vector3d &p : {Eigen::Vector3d(2, 2, 1), Eigen::Vector3d(1, 1, 2), Eigen::Vector3d(3, 3, 3.9)})
  {
    EXPECT_TRUE(test.is_inside(p)) << "under the diagonal of the lid";
    EXPECT_FALSE(test.is_inside(p + Eigen::Vector3d(0, 0, 10)));
    EXPECT_FALSE(test.is_inside(p - Eigen::Vector3d(0, 0, 10)));
  }
  const dataset::SurfaceMesh sphere = test::icosphere({0, 0, 0}, 10, 2);
  const InsideTest round(sphere.points, sphere.triangles);
  for (Eigen::Index node = 0; node < sphere.points.rows(); ++node)
  {
    const Eigen::Vector3d below(0.5 * sphere.points(node, 0), 0.5 * sphere.points(node, 1), -100);
    EXPECT_FALSE(round.is_inside(below));
    Eigen::Vector3d under = sphere.points.row(node);
    if (std::hypot(under.x(), under.y()) > 9)
      continue; // at the rim the half line through a node passes a wall of no thickness
    under.z() = 0;
    EXPECT_TRUE(round.is_inside(under)) << "under node " << node;
    under.z() = -100;
    EXPECT_FALSE(round.is_inside(under)) << "under node " << node << " and its opposite";
  }
}

TEST(InsideTest, RefusesWhatIsNoSurface)
{
  dataset::SurfaceMesh box = test::box({0, 0, 0}, {4, 4, 4});
  EXPECT_THROW(InsideTest(box.points, dataset::Triangles(0, 3)), InputError);
  EXPECT_THROW(InsideTest(box.points.topRows(7), box.triangles), InputError);
  box.points(3, 0) = std::nan("");
  EXPECT_THROW(InsideTest(box.points, box.triangles), InputError);
  EXPECT_FALSE(InsideTest(test::box({0, 0, 0}, {4, 4, 4}).points, box.triangles).is_inside({std::nan(""), 1, 1}));
}
} // namespace
} // namespace pelvireg::metrics
