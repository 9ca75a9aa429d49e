#include "synthetic/dataset/error.h"
#include "synthetic/observation/observe.h"
#include "tests/unit/observation/surfaces.h"

#include <gtest/gtest.h>

namespace pelvireg::observation
{
namespace
{
using namespace test;

/// Four organs that move by a known affine motion in three increments.
dataset::Anatomy example_anatomy()
{
  dataset::Anatomy anatomy;
  anatomy.case_name = "example";
  anatomy.dyn_plane.origin = {3, 0, 0};
  anatomy.dyn_plane.normal = Vector3d(1, 0.05, 0.02).normalized();
  return anatomy;
}

dataset::Truth example_truth()
{
  dataset::Truth truth;
  truth.case_name = "example";
  truth.increments.resize(3);
  const std::vector<dataset::SurfaceMesh> shapes = {sphere(28, 3), capped_tube(9, 70, 20, 20), sphere(22, 3),
                                                    capped_tube(14, 110, 20, 30)};
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    dataset::TruthSurface surface{dataset::organ_names[i], shapes[i], {}};
    surface.rest.points.col(1).array() += 60.0 * static_cast<double>(i);
    for (int k = 1; k <= 3; ++k)
      surface.displacements.push_back(Eigen::RowVector3d(0.5 * k, k, -3 * k).replicate(surface.rest.points.rows(), 1));
    truth.surfaces.push_back(surface);
  }
  return truth;
}

TEST(Observe, gives_a_frame_an_increment_and_fifteen_slices_at_the_pitch)
{
  const auto anatomy = example_anatomy();
  const auto observations = observe(anatomy, example_truth());
  EXPECT_EQ(observations.case_name, "example");
  EXPECT_EQ(observations.rest.increment, 0);
  ASSERT_EQ(observations.frames.size(), 3u);
  for (int k = 1; k <= 3; ++k)
    EXPECT_EQ(observations.frames[static_cast<std::size_t>(k - 1)].increment, k);
  ASSERT_EQ(observations.slices.size(), 15u);
  for (int k = -7; k <= 7; ++k)
  {
    const auto &slice = observations.slices[static_cast<std::size_t>(k + 7)];
    EXPECT_EQ(slice.index, k);
    EXPECT_NEAR((slice.plane.origin - anatomy.dyn_plane.origin).dot(anatomy.dyn_plane.normal), 6.0 * k, 1e-12);
    EXPECT_GT(slice.plane.normal.x(), 0);
  }
}

TEST(Observe, slice_0_is_the_last_frame)
{
  const auto observations = observe(example_anatomy(), example_truth());
  const auto &slice = observations.slices[7].outlines, &frame = observations.frames.back().outlines;
  for (std::size_t organ = 0; organ < 4; ++organ)
  {
    ASSERT_EQ(slice[organ].contours.size(), frame[organ].contours.size());
    EXPECT_EQ(slice[organ].contours.at(0).points, frame[organ].contours.at(0).points);
  }
}

TEST(Observe, everything_lies_in_the_plane_that_is_fixed_in_space)
{
  const auto anatomy = example_anatomy();
  const auto observations = observe(anatomy, example_truth());
  int n_points = 0;
  for (const auto &frame : observations.frames)
    for (std::size_t organ = 0; organ < 4; ++organ)
    {
      EXPECT_EQ(frame.outlines[organ].organ, dataset::organ_names[organ]);
      const auto &points = frame.control_points[organ];
      n_points += static_cast<int>(points.rows());
      for (Eigen::Index i = 0; i < points.rows(); ++i)
        EXPECT_NEAR((Vector3d(points.row(i)) - anatomy.dyn_plane.origin).dot(anatomy.dyn_plane.normal), 0, 1e-10);
    }
  EXPECT_EQ(n_points, 3 * 70);
}

TEST(Observe, sees_the_deformed_organ_not_the_rest)
{
  const auto observations = observe(example_anatomy(), example_truth());
  const auto height = [](const dataset::DynamicFrame &frame)
  { return frame.outlines[0].contours.at(0).points.col(2).mean(); };
  EXPECT_NEAR(height(observations.frames[2]) - height(observations.rest), -9, 0.5);
}

TEST(Observe, is_the_same_twice)
{
  const auto a = observe(example_anatomy(), example_truth()), b = observe(example_anatomy(), example_truth());
  for (std::size_t organ = 0; organ < 4; ++organ)
  {
    EXPECT_EQ(a.frames[2].control_points[organ], b.frames[2].control_points[organ]);
    EXPECT_EQ(a.frames[2].control_point_normals[organ], b.frames[2].control_point_normals[organ]);
  }
}

TEST(Observe, another_case_a_missing_organ_and_missing_increments_are_refused)
{
  auto truth = example_truth();
  truth.case_name = "other";
  EXPECT_THROW(observe(example_anatomy(), truth), InputError);
  truth = example_truth();
  truth.surfaces.erase(truth.surfaces.begin() + 2);
  EXPECT_THROW(observe(example_anatomy(), truth), InputError);
  truth = example_truth();
  truth.surfaces[1].displacements.pop_back();
  EXPECT_THROW(observe(example_anatomy(), truth), InputError);
}
} // namespace
} // namespace pelvireg::observation
