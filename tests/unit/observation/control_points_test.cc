#include "synthetic/dataset/error.h"
#include "synthetic/observation/control_points.h"
#include "tests/unit/observation/surfaces.h"

#include <gtest/gtest.h>

#include <limits>

namespace pelvireg::observation
{
namespace
{
using namespace test;
using dataset::Plane;
using dataset::SurfaceRegion;

const Plane sagittal{{0.37, 0, 0}, {1, 0, 0}};

OrganSection section(const dataset::SurfaceMesh &mesh, const Plane &plane = sagittal)
{
  return {mesh, intersect(mesh, plane, "organ")};
}

dataset::SurfaceMesh moved(dataset::SurfaceMesh mesh, const Vector3d &by)
{
  mesh.points.rowwise() += by.transpose();
  return mesh;
}

double distance_to(const std::vector<PlaneLoop> &loops, const Vector3d &point)
{
  double best = std::numeric_limits<double>::infinity();
  for (const PlaneLoop &loop : loops)
    for (Eigen::Index i = 0; i < loop.contour.points.rows(); ++i)
    {
      const Vector3d p = loop.contour.points.row(i), q = loop.contour.points.row((i + 1) % loop.contour.points.rows());
      const double t = std::clamp((point - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
      best = std::min(best, (point - p - t * (q - p)).norm());
    }
  return best;
}

/// A bladder (closed outline), a rectum (two walls between caps), one larger than the other.
std::vector<OrganSection> two_organs()
{
  return {section(sphere(25, 4)), section(moved(capped_tube(12, 90, 24, 30), {0, 60, 0}))};
}

TEST(ControlPoints, total_is_exactly_the_wanted_number)
{
  const auto rest = two_organs();
  for (const int wanted : {6, 20, 70, 71, 200})
  {
    const ControlPointLayout layout(rest, wanted, 0);
    EXPECT_EQ(layout.place(0, rest[0]).points.rows() + layout.place(1, rest[1]).points.rows(), wanted);
  }
}

TEST(ControlPoints, spacing_is_the_same_on_every_organ)
{
  const auto rest = two_organs();
  const ControlPointLayout layout(rest, 70, 0);
  const auto spacing_of = [](const ControlPoints &points, Eigen::Index i)
  { return (points.points.row(i + 1) - points.points.row(i)).norm(); };
  const ControlPoints bladder = layout.place(0, rest[0]), rectum = layout.place(1, rest[1]);
  for (Eigen::Index i = 0; i < 10; ++i)
  {
    EXPECT_NEAR(spacing_of(bladder, i), layout.spacing(), 0.06 * layout.spacing());
    EXPECT_NEAR(spacing_of(rectum, i), layout.spacing(), 0.06 * layout.spacing());
  }
}

TEST(ControlPoints, a_given_spacing_is_kept_within_half_a_point_per_stretch)
{
  const auto rest = two_organs();
  const ControlPointLayout layout(rest, 70, 7.5);
  EXPECT_EQ(layout.spacing(), 7.5);
  EXPECT_EQ(layout.place(1, rest[1]).points.rows(), 2 * 12); // two walls of 90 mm
}

TEST(ControlPoints, lie_on_the_outline_with_unit_outward_normals_in_the_plane)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial)
  {
    auto mesh = sphere(25, 4);
    deform(mesh, random);
    const Plane plane = random_plane(random, 8);
    const OrganSection organ = section(mesh, plane);
    const ControlPointLayout layout({organ}, 40, 0);
    const ControlPoints placed = layout.place(0, organ);
    ASSERT_EQ(placed.points.rows(), 40);
    const Vector3d centre = organ.loops[0].contour.points.colwise().mean();
    for (Eigen::Index i = 0; i < placed.points.rows(); ++i)
    {
      const Vector3d point = placed.points.row(i), normal = placed.normals.row(i);
      EXPECT_LT(distance_to(organ.loops, point), 1e-12);
      EXPECT_NEAR(normal.norm(), 1, 1e-12);
      EXPECT_NEAR(normal.dot(plane.normal), 0, 1e-12);
      EXPECT_GT(normal.dot(point - centre), 0); // the deformed sphere stays star-shaped
    }
  }
}

TEST(ControlPoints, normals_are_those_of_the_smooth_contour_not_of_the_facets)
{
  const OrganSection organ = section(sphere(25, 4));
  const ControlPoints placed = ControlPointLayout({organ}, 30, 0).place(0, organ);
  for (Eigen::Index i = 0; i < placed.points.rows(); ++i)
  {
    const Vector3d radial = (Vector3d(placed.points.row(i)) - sagittal.origin).normalized();
    EXPECT_GT(placed.normals.row(i).dot(radial), std::cos(0.01)); // facets alone deviate by up to 0.06
  }
}

TEST(ControlPoints, none_on_or_near_a_cap)
{
  const OrganSection rectum = section(capped_tube(12, 90, 24, 30));
  const ControlPoints placed = ControlPointLayout({rectum}, 20, 0).place(0, rectum);
  ASSERT_EQ(placed.points.rows(), 20);
  const double half_spacing = 0.5 * 90 / 10;
  for (Eigen::Index i = 0; i < placed.points.rows(); ++i)
  {
    EXPECT_GE(placed.points(i, 2), half_spacing - 1e-9);
    EXPECT_LE(placed.points(i, 2), 90 - half_spacing + 1e-9);
    EXPECT_NEAR(std::abs(placed.normals(i, 1)), 1, 1e-9);
  }
}

TEST(ControlPoints, none_on_the_cervix_patch)
{
  auto uterus = sphere(25, 4);
  for (Eigen::Index t = 0; t < uterus.triangles.rows(); ++t)
  {
    double z = 0;
    for (int i = 0; i < 3; ++i)
      z += uterus.points(uterus.triangles(t, i), 2) / 3;
    if (z < -18)
      uterus.region[t] = static_cast<int>(SurfaceRegion::cervix_patch);
  }
  const OrganSection organ = section(uterus);
  const ControlPoints placed = ControlPointLayout({organ}, 30, 0).place(0, organ);
  ASSERT_EQ(placed.points.rows(), 30);
  EXPECT_GT(placed.points.col(2).minCoeff(), -18);
}

TEST(ControlPoints, follow_an_in_plane_translation_exactly)
{
  const auto rest = two_organs();
  const ControlPointLayout layout(rest, 70, 0);
  const Vector3d shift(0, 4, -9);
  for (std::size_t organ = 0; organ < 2; ++organ)
  {
    const ControlPoints before = layout.place(organ, rest[organ]);
    const ControlPoints after = layout.place(organ, section(moved(rest[organ].surface, shift)));
    ASSERT_EQ(before.points.rows(), after.points.rows());
    EXPECT_LT(((after.points - before.points).rowwise() - shift.transpose()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(ControlPoints, follow_a_rotation_in_the_plane_on_a_closed_outline)
{
  const OrganSection rest = section(sphere(25, 4));
  const ControlPointLayout layout({rest}, 30, 0);
  const Eigen::AngleAxisd rotation(0.6, Vector3d::UnitX());
  dataset::SurfaceMesh turned = rest.surface;
  turned.points = turned.points * rotation.toRotationMatrix().transpose();
  const ControlPoints before = layout.place(0, rest), after = layout.place(0, section(turned));
  EXPECT_LT((after.points - before.points * rotation.toRotationMatrix().transpose()).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ControlPoints, do_not_jump_between_close_frames)
{
  const auto rest = two_organs();
  const ControlPointLayout layout(rest, 70, 0);
  for (std::size_t organ = 0; organ < 2; ++organ)
  {
    ControlPoints previous = layout.place(organ, rest[organ]);
    for (int k = 1; k <= 20; ++k)
    {
      auto mesh = rest[organ].surface;
      for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
        mesh.points.row(i) += 0.02 * k * Eigen::RowVector3d(8, 0.1 * mesh.points(i, 2), -6);
      const ControlPoints placed = layout.place(organ, section(mesh));
      ASSERT_EQ(placed.points.rows(), previous.points.rows());
      EXPECT_LT((placed.points - previous.points).rowwise().norm().maxCoeff(), 0.6); // the material moves 0.2 a frame
      previous = placed;
    }
  }
}

TEST(ControlPoints, a_hole_gets_none)
{
  const Plane across{{0, 0, 0.3}, {0, 0, 1}};
  const OrganSection ring = section(torus(30, 10, 128, 32), across);
  ASSERT_EQ(ring.loops.size(), 2u);
  const ControlPoints placed = ControlPointLayout({ring}, 25, 0).place(0, ring);
  ASSERT_EQ(placed.points.rows(), 25);
  EXPECT_GT(placed.points.rowwise().norm().minCoeff(), 39);
}

TEST(ControlPoints, a_frame_with_more_loops_than_at_rest_keeps_the_spacing)
{
  const Plane rest_plane{{29, 0, 0}, {1, 0, 0}}; // through the ring's side: one loop
  const auto mesh = torus(30, 10, 128, 32);
  const OrganSection rest = section(mesh, rest_plane);
  ASSERT_EQ(rest.loops.size(), 1u);
  const ControlPointLayout layout({rest}, 0, 5);
  const OrganSection later = section(moved(mesh, {29.4, 0, 0}), rest_plane); // now two
  ASSERT_EQ(later.loops.size(), 2u);
  EXPECT_NEAR(static_cast<double>(layout.place(0, later).points.rows()),
              (later.loops[0].length + later.loops[1].length) / 5, 1.0);
}

TEST(ControlPoints, an_organ_out_of_the_plane_gets_none)
{
  const auto rest = two_organs();
  const ControlPointLayout layout(rest, 70, 0);
  EXPECT_EQ(layout.place(0, section(moved(rest[0].surface, {80, 0, 0}))).points.rows(), 0);
}

TEST(ControlPoints, a_plane_that_misses_everything_is_refused)
{
  const OrganSection missed = section(sphere(10, 2), {{50, 0, 0}, {1, 0, 0}});
  EXPECT_THROW(ControlPointLayout({missed}, 70, 0), InputError);
}
} // namespace
} // namespace pelvireg::observation
