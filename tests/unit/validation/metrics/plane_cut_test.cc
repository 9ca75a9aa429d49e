#include "validation/metrics/plane_cut.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/contour_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace pelvireg::metrics
{
namespace
{
using dataset::Plane;
using dataset::SurfaceMesh;

std::vector<CutSegment> cut(const SurfaceMesh &mesh, const Plane &plane)
{
  return cut_surface(mesh.points, mesh.triangles, mesh.region, plane);
}

/// Every cut edge is used by exactly two segments: the set of segments is a union of closed contours.
void expect_closed(const std::vector<CutSegment> &segments)
{
  std::map<std::pair<int, int>, int> uses;
  for (const CutSegment &segment : segments)
    for (const EdgeCut &end : segment.ends)
      ++uses[{end.node_a, end.node_b}];
  for (const auto &[edge, n] : uses)
    EXPECT_EQ(n, 2) << "edge " << edge.first << " " << edge.second;
}

TEST(PlaneCut, OfASphereIsTheCircleOfThatHeight)
{
  const SurfaceMesh sphere = test::icosphere({0, 0, 0}, 20, 5);
  const auto segments = cut(sphere, {{12.1, 0, 0}, {1, 0, 0}});
  const double radius = std::sqrt(20.0 * 20 - 12.1 * 12.1);
  const double edge = 20 * 1.2 / 32, sagitta = edge * edge / (2 * 20);
  expect_closed(segments);
  for (const CutSegment &segment : segments)
    for (const EdgeCut &end : segment.ends)
    {
      EXPECT_NEAR(end.position.x(), 12.1, 1e-13);
      // A chord's sagitta seen along the plane grows by 20 / radius.
      EXPECT_NEAR(end.position.tail<2>().norm(), radius, sagitta * 20 / radius);
    }
  EXPECT_NEAR(contour_length(segments), 2 * std::numbers::pi * radius, 0.01 * radius);
}

TEST(PlaneCut, ThroughNodesAndEdgesStaysClosed)
{
  // The plane x = 0 holds nodes and whole edges of this sphere.
  const SurfaceMesh sphere = test::icosphere({0, 0, 0}, 20, 2);
  const auto segments = cut(sphere, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(contour_length(segments), 2 * std::numbers::pi * 20, 1.5);
  const auto shifted = cut(sphere, {{1e-12, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(contour_length(segments), contour_length(shifted), 1e-9);
  expect_closed(shifted);
}

TEST(PlaneCut, ThatOnlyTouchesIsEmptyOnBothSides)
{
  SurfaceMesh mesh = test::icosphere({0, 0, 0}, 20, 2);
  const double top = mesh.points.col(0).maxCoeff();
  EXPECT_TRUE(cut(mesh, {{top + 1e-12, 0, 0}, {1, 0, 0}}).empty());
  EXPECT_LE(contour_length(cut(mesh, {{top, 0, 0}, {1, 0, 0}})), 1e-12);
  EXPECT_LE(contour_length(cut(mesh, {{top - 1e-12, 0, 0}, {1, 0, 0}})), 1e-4);
}

TEST(PlaneCut, LeavesCapsOut)
{
  SurfaceMesh mesh = test::square(10, 0, 1);
  EXPECT_EQ(cut(mesh, {{5, 0, 0}, {1, 0, 0}}).size(), 2u);
  mesh.region[0] = static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
  EXPECT_EQ(cut(mesh, {{5, 0, 0}, {1, 0, 0}}).size(), 1u);
}

TEST(PlaneCut, InterpolatesANodalFieldAtTheCut)
{
  const SurfaceMesh mesh = test::icosphere({0, 0, 0}, 20, 2);
  for (const CutSegment &segment : cut(mesh, {{3, 0, 0}, {1, 0, 0}}))
    EXPECT_LE((segment.ends[0].interpolate(2 * mesh.points) - 2 * segment.ends[0].position).norm(), 1e-13);
}

TEST(SlicePlane, LiesPitchTimesIndexAlongTheNormal)
{
  const Plane dyn{{3, 0, 0}, Eigen::Vector3d(1, 0.05, 0).normalized()};
  const Plane slice = slice_plane(dyn, -7, 6);
  EXPECT_NEAR((slice.origin - dyn.origin).dot(dyn.normal), -42, 1e-13);
  EXPECT_EQ(slice.normal, dyn.normal);
}

TEST(PlaneCut, RefusesANormalThatIsNotOfUnitLength)
{
  const SurfaceMesh mesh = test::square(10, 0, 1);
  EXPECT_THROW(cut(mesh, {{5, 0, 0}, {1.01, 0, 0}}), InputError);
  EXPECT_THROW(cut(mesh, {{std::nan(""), 0, 0}, {1, 0, 0}}), InputError);
}
} // namespace
} // namespace pelvireg::metrics
