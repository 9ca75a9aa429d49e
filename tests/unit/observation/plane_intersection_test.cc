#include "synthetic/dataset/error.h"
#include "synthetic/observation/plane_intersection.h"
#include "tests/unit/observation/surfaces.h"

#include <gtest/gtest.h>

namespace pelvireg::observation
{
namespace
{
using namespace test;
using dataset::Plane;

const Plane equator{{0, 0, 0}, {0, 0, 1}};

double total_area(const std::vector<PlaneLoop> &loops)
{
  double sum = 0;
  for (const PlaneLoop &loop : loops)
    sum += loop.area;
  return sum;
}

TEST(PlaneIntersection, sphere_gives_one_circle_of_pythagorean_radius)
{
  const double radius = 30, height = 11.3; // not through a vertex
  const auto loops = intersect(sphere(radius, 5), {{0, 0, height}, {0, 0, 1}}, "sphere");
  ASSERT_EQ(loops.size(), 1u);
  const auto &points = loops[0].contour.points;
  const double circle = std::sqrt(radius * radius - height * height);
  const Eigen::RowVector3d centre(0, 0, height);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    // a chord of the sphere's facet lies at most edge^2 / (8 R) below it: 0.03 mm
    EXPECT_NEAR((points.row(i) - centre).norm(), circle, 0.03);
    EXPECT_NEAR(points(i, 2), height, 1e-12);
  }
  EXPECT_NEAR(points.colwise().mean().norm(), height, 0.01);
  EXPECT_NEAR(loops[0].area, M_PI * circle * circle, 2e-3 * M_PI * circle * circle);
  EXPECT_NEAR(loops[0].length, 2 * M_PI * circle, 2e-3 * 2 * M_PI * circle);
}

TEST(PlaneIntersection, outer_loop_is_counter_clockwise_and_turns_with_the_plane)
{
  const auto mesh = sphere(20, 3);
  const auto up = intersect(mesh, {{0, 0, 1.234}, {0, 0, 1}}, "sphere");
  const auto down = intersect(mesh, {{0, 0, 1.234}, {0, 0, -1}}, "sphere");
  ASSERT_EQ(up.size(), 1u);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_GT(up[0].area, 0);
  EXPECT_GT(down[0].area, 0);
  const auto &p = up[0].contour.points;
  EXPECT_GT(Eigen::Vector3d(p.row(0)).cross(Eigen::Vector3d(p.row(1))).z(), 0);
}

TEST(PlaneIntersection, segment_normals_are_unit_in_the_plane_and_outward)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial)
  {
    auto mesh = torus(30, 10, 40, 24);
    deform(mesh, random);
    const Plane plane = random_plane(random, 15);
    for (const PlaneLoop &loop : intersect(mesh, plane, "torus"))
    {
      const auto &points = loop.contour.points;
      for (Eigen::Index i = 0; i < points.rows(); ++i)
      {
        const Vector3d normal = loop.contour.segment_normals.row(i);
        const Vector3d segment = (points.row((i + 1) % points.rows()) - points.row(i)).normalized();
        EXPECT_NEAR(normal.norm(), 1, 1e-12);
        EXPECT_NEAR(normal.dot(plane.normal), 0, 1e-12);
        // organ on the left: the outward normal is the direction turned clockwise (short segments have no exact one)
        if ((points.row((i + 1) % points.rows()) - points.row(i)).norm() > 1e-3)
        {
          EXPECT_NEAR(segment.cross(plane.normal).dot(normal), 1, 1e-6);
        }
      }
    }
  }
}

TEST(PlaneIntersection, torus_across_the_axis_gives_two_outer_loops)
{
  const auto loops = intersect(torus(30, 10, 64, 32), {{0.1, 0, 0}, {1, 0, 0}}, "torus");
  ASSERT_EQ(loops.size(), 2u);
  for (const PlaneLoop &loop : loops)
    EXPECT_NEAR(loop.area, M_PI * 100, 0.02 * M_PI * 100);
}

TEST(PlaneIntersection, torus_in_its_plane_gives_an_outer_loop_and_a_hole)
{
  const auto loops = intersect(torus(30, 10, 128, 32), {{0, 0, 0.3}, {0, 0, 1}}, "torus");
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_NEAR(loops[0].area, M_PI * 40 * 40, 0.01 * M_PI * 40 * 40);
  EXPECT_NEAR(loops[1].area, -M_PI * 20 * 20, 0.01 * M_PI * 20 * 20);
  for (Eigen::Index i = 0; i < loops[1].contour.points.rows(); ++i) // out of the organ is towards the axis
    EXPECT_LT(loops[1].contour.points.row(i).dot(loops[1].contour.segment_normals.row(i)), 0);
}

TEST(PlaneIntersection, plane_through_vertices_and_edges_gives_the_exact_square)
{
  for (const double sign : {1.0, -1.0})
  {
    const auto loops = intersect(octahedron(10), {{0, 0, 0}, {0, 0, sign}}, "octahedron");
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].contour.points.rows(), 4); // the eight crossed edges end in the four vertices of the equator
    EXPECT_DOUBLE_EQ(loops[0].area, 200);
    EXPECT_EQ(loops[0].contour.points.cwiseAbs().rowwise().maxCoeff(), Eigen::VectorXd::Constant(4, 10));
  }
}

class NearlyThroughVertices : public ::testing::TestWithParam<double>
{
};

TEST_P(NearlyThroughVertices, area_is_continuous_and_no_tiny_segment_is_left)
{
  const auto loops = intersect(sphere(10, 2), {{0, 0, GetParam()}, {0, 0, 1}}, "sphere");
  const auto exact = intersect(sphere(10, 2), equator, "sphere");
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_EQ(exact[0].contour.points.rows(), 16);
  EXPECT_NEAR(loops[0].area, exact[0].area, 1e-9);
  const auto &points = loops[0].contour.points;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    EXPECT_GT((points.row((i + 1) % points.rows()) - points.row(i)).norm(), merge_distance);
}
INSTANTIATE_TEST_SUITE_P(offsets, NearlyThroughVertices, ::testing::Values(-1e-12, 0.0, 1e-12));

TEST(PlaneIntersection, touching_a_vertex_gives_nothing_from_either_side)
{
  for (const double sign : {1.0, -1.0})
    for (const double beside : {-1e-12, 0.0, 1e-12})
      EXPECT_TRUE(intersect(octahedron(10), {{0, 0, 10 + beside}, {0, 0, sign}}, "octahedron").empty());
}

TEST(PlaneIntersection, touching_an_edge_gives_nothing_from_either_side)
{
  // a wedge: the ridge along y lies in the plane z = 5
  const auto wedge = to_mesh({{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {0, -5, 5}, {0, 5, 5}},
                             {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {2, 3, 5}, {1, 2, 5}, {1, 5, 4}, {3, 0, 4}, {3, 4, 5}});
  for (const double sign : {1.0, -1.0})
    EXPECT_TRUE(intersect(wedge, {{0, 0, 5}, {0, 0, sign}}, "wedge").empty());
  EXPECT_EQ(intersect(wedge, {{0, 0, 5 - 1e-6}, {0, 0, 1}}, "wedge").size(), 1u);
}

TEST(PlaneIntersection, a_face_in_the_plane_gives_its_border_only_if_the_body_is_on_the_negative_side)
{
  const auto tube = capped_tube(10, 20, 4, 1); // flat square ends at z = 0 and 20
  const auto top = intersect(tube, {{0, 0, 20}, {0, 0, 1}}, "tube");
  ASSERT_EQ(top.size(), 1u);
  EXPECT_NEAR(top[0].area, 200, 1e-9);
  EXPECT_TRUE(intersect(tube, {{0, 0, 20}, {0, 0, -1}}, "tube").empty());
  EXPECT_TRUE(intersect(tube, {{0, 0, 0}, {0, 0, 1}}, "tube").empty());
}

TEST(PlaneIntersection, region_and_triangle_are_those_of_the_cut_triangle)
{
  const auto tube = capped_tube(10, 40, 16, 8);
  const Plane plane{{0.37, 0, 0}, {1, 0, 0}};
  const auto loops = intersect(tube, plane, "tube");
  ASSERT_EQ(loops.size(), 1u);
  double cap_length = 0;
  const auto &contour = loops[0].contour;
  for (Eigen::Index i = 0; i < contour.points.rows(); ++i)
  {
    EXPECT_EQ(contour.segment_region[i], tube.region[loops[0].triangle[static_cast<std::size_t>(i)]]);
    if (contour.segment_region[i] == static_cast<int>(dataset::SurfaceRegion::cap))
      cap_length += (contour.points.row((i + 1) % contour.points.rows()) - contour.points.row(i)).norm();
  }
  EXPECT_NEAR(cap_length, loops[0].length - 80, 1e-9); // two walls of 40 mm, the rest are the caps
}

TEST(PlaneIntersection, does_not_depend_on_the_order_of_the_triangles)
{
  std::mt19937 random(3);
  auto mesh = torus(30, 10, 30, 20);
  deform(mesh, random);
  auto reversed = mesh;
  reversed.triangles = mesh.triangles.colwise().reverse().eval();
  const Plane plane = random_plane(random, 10);
  const auto a = intersect(mesh, plane, "torus"), b = intersect(reversed, plane, "torus");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(a[i].contour.points, b[i].contour.points);
}

TEST(PlaneIntersection, separate_bodies_sum_up_and_a_missed_body_gives_nothing)
{
  EXPECT_TRUE(intersect(sphere(10, 2), {{0, 0, 10.5}, {0, 0, 1}}, "sphere").empty());
  const auto loops = intersect(sphere(10, 2), equator, "sphere");
  EXPECT_NEAR(total_area(loops), loops.at(0).area, 0);
}

TEST(PlaneIntersection, an_open_surface_is_refused_by_name)
{
  auto open = sphere(10, 2);
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  const Vector3d hole = open.points.row(open.triangles(open.triangles.rows() - 1, 0));
  bool refused = false;
  for (const Vector3d &normal : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
    try
    {
      intersect(open, {0.98 * hole, normal}, "bladder");
    }
    catch (const InputError &error)
    {
      refused = true;
      EXPECT_NE(std::string(error.what()).find("bladder is not closed"), std::string::npos);
    }
  EXPECT_TRUE(refused);
}

TEST(PlaneIntersection, a_coordinate_that_is_no_number_is_refused)
{
  auto mesh = sphere(10, 1);
  mesh.points(3, 1) = std::nan("");
  EXPECT_THROW(intersect(mesh, equator, "uterus"), InputError);
}
} // namespace
} // namespace pelvireg::observation
