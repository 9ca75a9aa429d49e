#include "validation/metrics/penetration.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"

#include <gtest/gtest.h>

namespace pelvireg::metrics
{
TEST(Penetration, OfTwoSpheresIsTheDepthOfTheirLens)
{
  const dataset::SurfaceMesh a = test::icosphere({0, 0, 0}, 20, 4);
  for (const double depth : {0.2, 0.5, 3.0})
  {
    // Along a node's direction: the deepest node lies on the axis; facets of 1.4 mm sag by 0.02 mm.
    const Eigen::Vector3d direction = a.points.row(5).transpose().normalized();
    const dataset::SurfaceMesh b = test::icosphere((35 - depth) * direction, 15, 4);
    const Penetration found = penetration(a, b), other_way = penetration(b, a);
    EXPECT_NEAR(found.depth, depth, 0.04);
    EXPECT_NEAR(found.depth, other_way.depth, 1e-12);
    EXPECT_GT(found.n_inside, 0);
    EXPECT_NEAR(found.at.dot(direction), 20, 3.1);
  }
}

TEST(Penetration, OfSurfacesApartIsNone)
{
  const Penetration found = penetration(test::icosphere({0, 0, 0}, 20, 3), test::icosphere({0, 0, 35.1}, 15, 3));
  EXPECT_EQ(found.depth, 0);
  EXPECT_EQ(found.n_inside, 0);
}

TEST(Penetration, OfANestedBodyReachesFromItsFarthestPointToTheOuterWall)
{
  const Penetration found = penetration(test::icosphere({0, 0, 0}, 20, 3), test::icosphere({0, 0, 5}, 4, 2));
  EXPECT_NEAR(found.depth, 19, 0.3); // its lowest point, 1 mm above the centre
  EXPECT_EQ(found.n_inside, 20 * 16 + 10 * 16 + 2);
}

TEST(Penetration, ClosesBodiesByTheirCapsButDoesNotScoreThem)
{
  dataset::SurfaceMesh tube = test::icosphere({0, 0, 0}, 20, 3);
  for (Eigen::Index t = 0; t < tube.triangles.rows(); ++t)
    if (tube.points(tube.triangles(t, 0), 2) + tube.points(tube.triangles(t, 1), 2) +
            tube.points(tube.triangles(t, 2), 2) >
        3 * 12)
      tube.region[t] = static_cast<std::int32_t>(dataset::SurfaceRegion::cap); // the top
  const Penetration found = penetration(test::icosphere({0, 0, 20}, 2, 3), tube);
  EXPECT_GT(found.depth, 10); // from below the cap to the rim of the wall
}

TEST(Penetration, IsInsideIsDecidedOnBothSidesOfTheWall)
{
  const dataset::SurfaceMesh sphere = test::icosphere({1, 2, 3}, 10, 3);
  for (Eigen::Index node = 0; node < sphere.points.rows(); node += 7)
  {
    const Eigen::Vector3d centre(1, 2, 3), outward = sphere.points.row(node).transpose() - centre;
    EXPECT_TRUE(is_inside(centre + 0.9999 * outward, sphere.points, sphere.triangles));
    EXPECT_FALSE(is_inside(centre + 1.0001 * outward, sphere.points, sphere.triangles));
  }
}

TEST(Penetration, RefusesASurfaceThatIsNotFinite)
{
  dataset::SurfaceMesh broken = test::icosphere({0, 0, 0}, 20, 1);
  broken.points(3, 1) = std::nan("");
  EXPECT_THROW(penetration(broken, test::icosphere({0, 0, 0}, 20, 1)), InputError);
  EXPECT_THROW(penetration(test::icosphere({0, 0, 0}, 20, 1), broken), InputError);
}
} // namespace pelvireg::metrics
