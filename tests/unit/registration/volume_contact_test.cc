#include "registration/constraints/contact_rows.h"
#include "registration/constraints/volume_contact.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::registration
{
namespace
{
using std::numbers::pi;

/// Two closed surfaces and what contact finds of them.
struct Scene
{
  Body a, b;
  TriangleTree walls_a, walls_b;
  VolumeContact contact;

  Scene(Body body_a, Body body_b, const ContactGrid &grid)
      : a(std::move(body_a)), b(std::move(body_b)), walls_a(a.outer_triangles, a.rest_positions),
        walls_b(b.outer_triangles, b.rest_positions),
        contact(static_cast<int>(a.rest_positions.rows()), static_cast<int>(b.rest_positions.rows()))
  {
    contact.detect({&a.outer_triangles, &a.rest_positions, &a.is_wall, &walls_a},
                   {&b.outer_triangles, &b.rest_positions, &b.is_wall, &walls_b}, grid);
  }

  const Body &body(int side) const { return side == 0 ? a : b; }

  /// Gradient of the overlap volume of one cell under the motion `velocity`(side, position) of all nodes, mm^3 a unit.
  template <class Velocity> double volume_rate(const Contact &cell, const Velocity &velocity) const
  {
    double rate = 0;
    for (int s = cell.first_share; s < cell.end_share; ++s)
    {
      const ContactShare &share = contact.shares()[s];
      const Eigen::Vector3d position = body(share.side).rest_positions.row(share.node).transpose();
      rate -= cell.area * share.normal_jacobian.dot(velocity(share.side, position));
    }
    return rate;
  }
};

/// Everything in one cell, no margin.
ContactGrid whole(double pixel)
{
  return {pixel, 1e5, 0};
}

/// One cell holds all when the origin is no corner of it.
const Eigen::Vector3d off_the_corner(40, 40, 40);

Body turned(Body body, const Eigen::Matrix3d &rotation)
{
  for (auto position : body.rest_positions.rowwise())
    position = (rotation * (position.transpose() - off_the_corner) + off_the_corner).transpose();
  return body;
}

Scene two_spheres(double radius_a, double radius_b, const Eigen::Vector3d &between, double pixel)
{
  return {scene::hollow_ellipsoid(Eigen::Vector3d::Constant(radius_a), 2, 5, off_the_corner),
          scene::hollow_ellipsoid(Eigen::Vector3d::Constant(radius_b), 2, 5, off_the_corner + between), whole(pixel)};
}
} // namespace

// Lens of two spheres: volume pi (R + r - d)^2 (d^2 + 2 d (R + r) - 3 (R - r)^2) / (12 d). Moving one away reduces it
// by the area of the lens' circle; letting a sphere grow adds the area of its cap in the other.
TEST(VolumeContact, FindsTheLensOfTwoSpheresAndItsGradient)
{
  const double r = 20, s = 15;
  for (const Eigen::Vector3d &direction :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 2, -0.7)})
    for (const double d : {28.0, 33.0})
    {
      const Eigen::Vector3d unit = direction.normalized();
      const Scene scene = two_spheres(r, s, d * unit, 0.5);
      ASSERT_EQ(scene.contact.contacts().size(), 1u);
      const Contact &lens = scene.contact.contacts()[0];
      const double volume = pi * std::pow(r + s - d, 2) * (d * d + 2 * d * (r + s) - 3 * (r - s) * (r - s)) / (12 * d);
      const double to_circle = (d * d + r * r - s * s) / (2 * d);
      const double circle = pi * (r * r - to_circle * to_circle);
      // Inscribed polyhedra of 1280 x 4 triangles are 0.1 % smaller; a lens 2 mm deep sees that as 1 %.
      EXPECT_NEAR(scene.contact.overlap_volume() / volume, 1, 0.04) << d << ", " << direction.transpose();
      EXPECT_NEAR(lens.depth * lens.area, scene.contact.overlap_volume(), 1e-9 * volume);
      EXPECT_NEAR(lens.area / circle, 1, 0.02);
      EXPECT_GE(lens.normal.dot(-unit), 1 - 1e-3);
      const auto apart = [&](int side, const Eigen::Vector3d &) -> Eigen::Vector3d
      { return side == 1 ? unit : Eigen::Vector3d::Zero(); };
      EXPECT_NEAR(scene.volume_rate(lens, apart) / -circle, 1, 0.02);
      const auto growing = [&](int side, const Eigen::Vector3d &x) -> Eigen::Vector3d
      { return side == 0 ? (x - off_the_corner).normalized() : Eigen::Vector3d::Zero(); };
      EXPECT_NEAR(scene.volume_rate(lens, growing) / (2 * pi * r * (r - to_circle)), 1, 0.02);
      EXPECT_NEAR(scene.contact.deepest_overlap(), r + s - d, 0.2);
      EXPECT_EQ(scene.contact.n_open_rays(), 0);
      RecordProperty("volume_ratio", std::to_string(scene.contact.overlap_volume() / volume));
    }
}

TEST(VolumeContact, ConvergesToTheLensAsRaysGetDenser)
{
  const Scene reference = two_spheres(20, 15, Eigen::Vector3d(17, 19, 20), 0.1);
  double error[2];
  for (const int level : {0, 1})
    error[level] =
        std::abs(two_spheres(20, 15, Eigen::Vector3d(17, 19, 20), level == 0 ? 1 : 0.25).contact.overlap_volume() /
                     reference.contact.overlap_volume() -
                 1);
  EXPECT_LE(error[0], 0.02);
  EXPECT_LE(error[1], 0.003);
}

TEST(VolumeContact, ActionIsReactionInForceAndMomentInEveryCell)
{
  const Scene scene(scene::hollow_ellipsoid({20, 26, 17}, 2, 3, off_the_corner),
                    scene::hollow_ellipsoid({14, 17, 23}, 2, 3, off_the_corner + Eigen::Vector3d(17, 21, 18)),
                    {1, 6, 0.5});
  ASSERT_GE(scene.contact.contacts().size(), 4u);
  for (const Contact &cell : scene.contact.contacts())
  {
    Eigen::Vector3d force[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double weight[2] = {0, 0};
    for (int s = cell.first_share; s < cell.end_share; ++s)
    {
      const ContactShare &share = scene.contact.shares()[s];
      force[share.side] += share.normal_jacobian;
      weight[share.side] += share.weight;
      moment += Eigen::Vector3d(scene.body(share.side).rest_positions.row(share.node).transpose())
                    .cross(share.normal_jacobian);
    }
    EXPECT_LE((force[0] + force[1]).norm(), 1e-13);
    EXPECT_LE((force[0] - cell.normal).norm(), 1e-13);
    EXPECT_LE(moment.norm(), 1e-6); // lever of the corners' snapping, mm
    EXPECT_NEAR(weight[0], 1, 1e-13);
    EXPECT_NEAR(weight[1], 1, 1e-13);
  }
}

// The raster is fixed in space. What it says of two bodies must not depend on how these lie in it: at the raster that
// the registration uses, volume within 2 % and force within 2 %, 1 degree.
TEST(VolumeContact, DependsLittleOnTheRastersOrientation)
{
  const Body a = scene::hollow_ellipsoid({20, 26, 17}, 2, 4, off_the_corner);
  const Body b = scene::hollow_ellipsoid({14, 17, 23}, 2, 4, off_the_corner + Eigen::Vector3d(15, 18, 15));
  const Scene straight(a, b, whole(1));
  double worst_volume = 0, worst_area = 0, worst_angle = 0;
  for (int k = 1; k <= 12; ++k)
  {
    const Eigen::Matrix3d rotation(
        Eigen::AngleAxisd(0.5 * k, Eigen::Vector3d(std::sin(k), std::cos(2 * k), 0.3 * k).normalized()));
    const Scene scene(turned(a, rotation), turned(b, rotation), whole(1));
    ASSERT_EQ(scene.contact.contacts().size(), 1u);
    const Contact &one = straight.contact.contacts()[0], &other = scene.contact.contacts()[0];
    worst_volume =
        std::max(worst_volume, std::abs(scene.contact.overlap_volume() / straight.contact.overlap_volume() - 1));
    worst_area = std::max(worst_area, std::abs(other.area / one.area - 1));
    worst_angle = std::max(worst_angle, std::acos(std::min(1.0, other.normal.dot(rotation * one.normal))));
  }
  RecordProperty("volume", std::to_string(worst_volume));
  RecordProperty("area", std::to_string(worst_area));
  RecordProperty("angle", std::to_string(worst_angle));
  EXPECT_LE(worst_volume, 0.02);
  EXPECT_LE(worst_area, 0.02);
  EXPECT_LE(worst_angle, pi / 180);
}

// Corners, edges and diagonals of the blocks lie on rays: each must count once.
TEST(VolumeContact, SeesRaysThroughCornersAndEdgesOnce)
{
  const Scene scene(scene::block({8, 8, 8}, {4, 4, 4}, true, true, {0.5, 0.5, 0.5}),
                    scene::block({6, 6, 8}, {3, 3, 4}, true, true, {1.5, 1.5, 6.5}), whole(1));
  EXPECT_EQ(scene.contact.n_open_rays(), 0);
  ASSERT_EQ(scene.contact.contacts().size(), 1u);
  EXPECT_NEAR(scene.contact.contacts()[0].area, 36, 1e-9);
  EXPECT_NEAR(scene.contact.overlap_volume(), 36 * 2, 1e-9);
  EXPECT_NEAR(scene.contact.contacts()[0].normal.z(), -1, 1e-12);
  EXPECT_NEAR(scene.contact.deepest_overlap(), 2, 1e-12);
}

TEST(VolumeContact, LeavesOutAndCountsRaysThatSeeAnOpenSurface)
{
  Body open = scene::block({8, 8, 8}, {1, 1, 1}, true, true, {0, 0, 0});
  const Body other = scene::block({8, 8, 8}, {1, 1, 1}, true, true, {0, 0, 6});
  const Scene closed(open, other, whole(1));
  Eigen::Index top = 0;
  while (open.rest_positions(open.outer_triangles(top, 0), 2) + open.rest_positions(open.outer_triangles(top, 1), 2) +
             open.rest_positions(open.outer_triangles(top, 2), 2) <
         24)
    ++top;
  open.outer_triangles.row(top) = open.outer_triangles.row(open.outer_triangles.rows() - 1).eval();
  open.outer_triangles.conservativeResize(open.outer_triangles.rows() - 1, 3);
  const Scene scene(open, other, whole(1));
  EXPECT_GE(scene.contact.n_open_rays(), 24);
  EXPECT_LT(scene.contact.contacts()[0].area, 0.7 * closed.contact.contacts()[0].area);
}

TEST(VolumeContact, FollowsSurfacesThatAreAlmostInTouch)
{
  for (const double gap : {0.1, 0.3, 0.49, 0.51})
  {
    const Scene scene(scene::block({12, 12, 8}, {2, 2, 1}, true, true),
                      scene::block({12, 12, 8}, {2, 2, 1}, true, true, {0, 0, 8 + gap}), {1, 1e5, 0.5});
    ASSERT_EQ(scene.contact.contacts().size(), gap < 0.5 ? 1u : 0u) << gap;
    EXPECT_EQ(scene.contact.deepest_overlap(), 0);
    EXPECT_EQ(scene.contact.overlap_volume(), 0);
    for (const Contact &contact : scene.contact.contacts())
      EXPECT_NEAR(contact.depth, -gap, 1e-9);
  }
}

TEST(VolumeContact, OfTrianglesThatMayNotTouchThereIsNone)
{
  const Body lower = scene::block({12, 12, 8}, {2, 2, 1}, true, true);
  Body upper = scene::block({10, 10, 8}, {2, 2, 1}, true, true, {1, 1, 7});
  const double all = Scene(lower, upper, whole(1)).contact.overlap_volume();
  for (Eigen::Index t = 0; t < upper.outer_triangles.rows(); ++t)
    for (int i = 0; i < 3; ++i)
      if (upper.rest_positions(upper.outer_triangles(t, i), 0) > 6.5)
        upper.is_wall[t] = 0; // the half beyond x = 6
  const Scene half(lower, upper, whole(1));
  EXPECT_NEAR(half.contact.overlap_volume() / all, 0.5, 0.01);
  for (const ContactShare &share : half.contact.shares())
    EXPECT_LE(half.body(share.side).rest_positions(share.node, 0), share.side == 1 ? 6.1 : 12.1);
}

TEST(VolumeContact, DrivesANestedBodyOutAlongTheShortestWay)
{
  const Body outer = scene::block({40, 30, 30}, {4, 3, 3}, true, true, {20, 25, 25});
  const Body inner = scene::hollow_ellipsoid({4, 4, 4}, 1, 3, {42, 39, 48});
  const Scene scene(outer, inner, whole(0.5));
  ASSERT_EQ(scene.contact.contacts().size(), 1u);
  const Contact &contact = scene.contact.contacts()[0];
  EXPECT_LE((contact.normal - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12); // of body a; b leaves through the top
  EXPECT_NEAR(scene.contact.deepest_overlap(), 15 - (8 - 4), 0.1);
  EXPECT_GT(contact.depth, 5);
}

TEST(VolumeContact, OfTwoBodiesApartThereIsNothing)
{
  const Scene scene(scene::hollow_ellipsoid({10, 10, 10}, 2, 2),
                    scene::hollow_ellipsoid({10, 10, 10}, 2, 2, {30, 0, 0}), {1, 8, 0.5});
  EXPECT_TRUE(scene.contact.contacts().empty());
  EXPECT_EQ(scene.contact.overlap_volume(), 0);
}

TEST(Tangents, AreUnitAndAcross)
{
  for (const Eigen::Vector3d &direction :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, -2, 0.3),
        Eigen::Vector3d(1e-9, 0, -1)})
  {
    Eigen::Matrix3d frame;
    frame.col(0) = direction.normalized();
    frame.col(1) = tangents(frame.col(0))[0];
    frame.col(2) = tangents(frame.col(0))[1];
    EXPECT_LE((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  }
}
} // namespace pelvireg::registration
