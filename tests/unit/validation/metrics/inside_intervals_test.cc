// Volumes in common and Dice, by lines 1 mm apart as the judge uses them.
#include "validation/metrics/inside_intervals.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/validation/fixtures/shapes.h"
#include "validation/metrics/enclosed_volume.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::metrics
{
namespace
{
InsideIntervals inside(const dataset::SurfaceMesh &mesh, double spacing = 1)
{
  return InsideIntervals(mesh.points, mesh.triangles, spacing);
}

double exact_volume(const dataset::SurfaceMesh &mesh)
{
  return enclosed_volume(mesh.points, mesh.triangles);
}

dataset::SurfaceMesh joined(const dataset::SurfaceMesh &a, const dataset::SurfaceMesh &b)
{
  dataset::SurfaceMesh mesh;
  mesh.points.resize(a.points.rows() + b.points.rows(), 3);
  mesh.points << a.points, b.points;
  mesh.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  mesh.triangles << a.triangles, (b.triangles.array() + static_cast<std::int32_t>(a.points.rows())).matrix();
  return mesh;
}

TEST(InsideIntervals, VolumeIsThePolyhedronsWithinAThousandth)
{
  for (const Eigen::Vector3d &axes : {Eigen::Vector3d(20, 20, 20), Eigen::Vector3d(40, 28, 9)})
    for (int place = 0; place < 5; ++place)
    {
      const dataset::SurfaceMesh body = test::ellipsoid({0.31 * place, -7.7 * place, 0.05 * place}, axes, 4);
      EXPECT_NEAR(inside(body).volume() / exact_volume(body), 1, 1e-3) << axes.transpose() << ", place " << place;
    }
}

TEST(InsideIntervals, ABoxAlongTheAxesOfSpaceIsNoSpecialCase)
{
  for (int place = 0; place < 20; ++place)
  {
    const dataset::SurfaceMesh box = test::box({0.05 * place, 0, 0}, {20.5, 30.5, 40.5});
    EXPECT_NEAR(inside(box).volume() / exact_volume(box), 1, 1e-3) << place;
  }
}

TEST(InsideIntervals, CommonVolumeOfBoxesIsTheirCommonBox)
{
  const dataset::SurfaceMesh a = test::box({0, 0, 0}, {30, 20, 25}), b = test::box({11.3, 4.1, -5.2}, {40, 10, 20});
  const double common = (30 - 11.3) * 10 * (20 - 5.2);
  EXPECT_NEAR(inside(a).common_volume(inside(b)) / common, 1, 3e-3);
  EXPECT_EQ(inside(a).common_volume(inside(b)), inside(b).common_volume(inside(a)));
}

TEST(InsideIntervals, CommonVolumeOfSpheresIsTheirLens)
{
  // 3 mm deep.
  const double r = 20, s = 15, distance = 32;
  const double lens = std::numbers::pi * std::pow(r + s - distance, 2) *
                      (distance * distance + 2 * distance * (r + s) - 3 * std::pow(r - s, 2)) / (12 * distance);
  const InsideIntervals a = inside(test::icosphere({0, 0, 0}, r, 5)),
                        b = inside(test::icosphere({0, 0, distance}, s, 5));
  EXPECT_NEAR(a.common_volume(b) / lens, 1, 0.02);
}

TEST(InsideIntervals, ErrorShrinksWithTheSpacing)
{
  const dataset::SurfaceMesh body = test::ellipsoid({1, 2, 3}, {25, 18, 12}, 4);
  double coarse = 0, fine = 0;
  for (int place = 0; place < 10; ++place)
  {
    dataset::SurfaceMesh moved = body;
    moved.points.rowwise() += Eigen::RowVector3d(0.37 * place, 0.21 * place, 0);
    coarse += std::abs(inside(moved, 4).volume() / exact_volume(body) - 1);
    fine += std::abs(inside(moved, 1).volume() / exact_volume(body) - 1);
  }
  EXPECT_LE(fine, coarse / 4);
}

TEST(Dice, IsOneForASurfaceAndItselfAndNoneForSurfacesApart)
{
  const InsideIntervals a = inside(test::icosphere({0, 0, 0}, 20, 3)), b = inside(test::icosphere({0, 0, 40.1}, 20, 3));
  EXPECT_DOUBLE_EQ(dice(a, a), 1);
  EXPECT_EQ(dice(a, b), 0);
}

TEST(Dice, OfANestedBoxAndOfAMovedOneIsThatOfTheirVolumes)
{
  const InsideIntervals outer = inside(test::box({0, 0, 0}, {30, 30, 30}));
  EXPECT_NEAR(dice(outer, inside(test::box({5, 5, 5}, {15, 20, 20}))), 2 * 6000.0 / (27000 + 6000), 2e-3);
  EXPECT_NEAR(dice(outer, inside(test::box({6, 0, 0}, {30, 30, 30}))), 0.8, 2e-3);
}

TEST(InsideIntervals, ASurfaceThroughItselfCountsItsOverlapOnceAndInsideOutPartsNot)
{
  const dataset::SurfaceMesh a = test::icosphere({0, 0, 0}, 20, 4), b = test::icosphere({0, 0, 10}, 20, 4);
  const double both = inside(a).volume() + inside(b).volume() - inside(a).common_volume(inside(b));
  EXPECT_NEAR(inside(joined(a, b)).volume(), both, 1e-9 * both);
  dataset::SurfaceMesh inverted = a;
  inverted.triangles.col(1).swap(inverted.triangles.col(2));
  EXPECT_EQ(inside(inverted).volume(), 0);
  dataset::SurfaceMesh hollow = test::icosphere({0, 0, 0}, 10, 4);
  hollow.triangles.col(1).swap(hollow.triangles.col(2));
  EXPECT_NEAR(inside(joined(a, hollow)).volume() / (exact_volume(a) + exact_volume(hollow)), 1, 1e-3);
}

TEST(InsideIntervals, RefusesWhatHasNoAnswer)
{
  const dataset::SurfaceMesh box = test::box({0, 0, 0}, {10, 10, 10});
  EXPECT_THROW(InsideIntervals(box.points, box.triangles.topRows(11), 1), InputError) << "open";
  for (const double spacing : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(InsideIntervals(box.points, box.triangles, spacing), InputError);
  dataset::Points broken = box.points;
  broken(3, 1) = std::nan("");
  EXPECT_THROW(InsideIntervals(broken, box.triangles, 1), InputError);
  broken = box.points;
  broken(3, 1) = 2000;
  EXPECT_NO_THROW(InsideIntervals(broken, box.triangles, 1));
  broken(3, 1) = 2000.001;
  EXPECT_THROW(InsideIntervals(broken, box.triangles, 1), InputError) << "flown apart";
  EXPECT_THROW(inside(box, 1).common_volume(inside(box, 2)), InputError);
  dataset::SurfaceMesh inverted = box;
  inverted.triangles.col(1).swap(inverted.triangles.col(2));
  EXPECT_THROW(dice(inside(inverted), inside(inverted)), InputError);
}
} // namespace
} // namespace pelvireg::metrics
