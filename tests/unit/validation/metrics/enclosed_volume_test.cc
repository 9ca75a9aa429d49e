#include "validation/metrics/enclosed_volume.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
TEST(EnclosedVolume, OfABoxIsTheProductOfItsEdgesWhereverItIs)
{
  for (const double far : {0.0, 1.0, 1e4})
  {
    const dataset::SurfaceMesh box = test::box({far, -2 * far, far}, {2, 3, 5});
    EXPECT_NEAR(enclosed_volume(box.points, box.triangles), 30, 1e-9) << far;
  }
}

TEST(EnclosedVolume, OfASphereGrowsToItsClosedForm)
{
  const double exact = 4.0 / 3 * std::numbers::pi * 1000;
  const auto volume = [](int n)
  {
    const dataset::SurfaceMesh sphere = test::icosphere({1, 2, 3}, 10, n);
    return enclosed_volume(sphere.points, sphere.triangles);
  };
  EXPECT_NEAR((exact - volume(3)) / (exact - volume(4)), 4, 0.1) << "second order in the edge";
  EXPECT_NEAR(volume(5), exact, 0.001 * exact);
}

TEST(EnclosedVolume, IsNegativeWhenTheNormalsPointInward)
{
  dataset::SurfaceMesh box = test::box({0, 0, 0}, {2, 3, 5});
  box.triangles.col(1).swap(box.triangles.col(2));
  EXPECT_NEAR(enclosed_volume(box.points, box.triangles), -30, 1e-12);
}

TEST(EnclosedVolume, RefusesOpenTwistedAndBrokenSurfaces)
{
  const dataset::SurfaceMesh box = test::box({0, 0, 0}, {2, 3, 5});
  EXPECT_NO_THROW(require_closed(box.triangles));
  EXPECT_NO_THROW(require_closed(test::icosphere({0, 0, 0}, 1, 3).triangles));
  const dataset::Triangles open = box.triangles.topRows(11);
  EXPECT_THROW(require_closed(open), InputError);
  dataset::Triangles twisted = box.triangles;
  std::swap(twisted(4, 0), twisted(4, 1));
  EXPECT_THROW(require_closed(twisted), InputError);
  dataset::Points broken = box.points;
  broken(7, 0) = std::nan("");
  EXPECT_THROW(enclosed_volume(broken, box.triangles), InputError);
  EXPECT_THROW(enclosed_volume(dataset::Points(0, 3), dataset::Triangles(0, 3)), InputError);
}
} // namespace
} // namespace pelvireg::metrics
