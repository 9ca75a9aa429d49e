#include "validation/runner/outer_surface.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/sphere_case.h"

#include <gtest/gtest.h>

namespace pelvireg::runner
{
namespace
{
TEST(OuterSurface, KeepsTheTrianglesAndDropsTheNodesInside)
{
  const dataset::RegistrationBody body = test::sphere_anatomy().registration.bodies.front();
  const OuterSurface surface = outer_surface(body);
  EXPECT_EQ(surface.rest.points.rows(), body.points.rows() - 1);
  ASSERT_EQ(surface.rest.triangles.rows(), body.outer_triangles.rows());
  for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(surface.rest.points.row(surface.rest.triangles(t, k)), body.points.row(body.outer_triangles(t, k)));
}

TEST(OuterSurface, PicksMovedPositionsOfItsNodes)
{
  const dataset::RegistrationBody body = test::sphere_anatomy().registration.bodies.front();
  const OuterSurface surface = outer_surface(body);
  EXPECT_EQ(surface.pick(2 * body.points), 2 * surface.rest.points);
}

TEST(OuterSurface, RefusesABodyWithoutSurfaceAndAnIndexOutOfRange)
{
  dataset::RegistrationBody body = test::sphere_anatomy().registration.bodies.front();
  body.outer_triangles(3, 1) = static_cast<std::int32_t>(body.points.rows());
  EXPECT_THROW(outer_surface(body), InputError);
  body.outer_triangles.resize(0, 3);
  EXPECT_THROW(outer_surface(body), InputError);
}

TEST(BodyIndex, NamesTheMissingBody)
{
  try
  {
    body_index(test::sphere_anatomy().registration, "spleen");
    FAIL() << "no exception";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("'spleen' is missing, got: bladder, vagina"), std::string::npos);
  }
}
} // namespace
} // namespace pelvireg::runner
