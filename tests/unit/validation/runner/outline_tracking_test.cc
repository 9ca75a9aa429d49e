#include "validation/runner/outline_tracking.h"

#include "synthetic/dataset/error.h"
#include "tests/unit/tracking/moving_scene.h"
#include "validation/runner/image_plane.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::runner
{
namespace
{
using dataset::Points;
using testing::HasSubstr;

constexpr int n_increments = 4, frames_per_increment = 2;
constexpr double spacing = 1.5; // mm

/// A scene in an oblique plane, with one organ that shifts and turns.
struct Series
{
  tracking::Scene scene;
  dataset::ImageSeries series;
  dataset::Observations exact;

  Series()
  {
    scene.organs = {{"bladder", {60, 64}, {24, 18}, 1.0, 2}};
    scene.noise = 0.03;
    scene.displacement = [](const Eigen::Vector2d &x)
    {
      const Eigen::Vector2d q = x - Eigen::Vector2d(60, 64);
      return Eigen::Vector2d(5 - 0.25 * q.y(), 3 + 0.25 * q.x());
    };
    dataset::ImageGeometry &geometry = series.geometry;
    const Eigen::Vector3d normal = Eigen::Vector3d(1, 0.1, 0.05).normalized();
    geometry.origin << 3, -80, 100;
    geometry.column_direction = (Eigen::Vector3d::UnitY() - normal.y() * normal).normalized();
    geometry.row_direction = geometry.column_direction.cross(normal).normalized();
    geometry.spacing = {spacing, spacing};
    geometry.columns = geometry.rows = scene.size;
    series.slice_thickness_mm = 7;
    exact.case_name = "scene";
    exact.dyn_plane = {geometry.origin, normal};
    for (int frame = 0; frame <= n_increments * frames_per_increment; ++frame)
    {
      series.times_s.push_back(0.4 * frame);
      const tracking::Image image = scene.image(time(frame), static_cast<unsigned>(frame) + 1);
      series.pixels.insert(series.pixels.end(), image.pixels.begin(), image.pixels.end());
    }
    exact.rest = rest_frame();
  }

  static double time(int frame) { return static_cast<double>(frame) / (n_increments * frames_per_increment); }
  Points outline(int frame) const { return to_space(series.geometry, scene.outline(0, time(frame))); }

  dataset::DynamicFrame rest_frame() const
  {
    dataset::Contour contour;
    contour.points = outline(0);
    const Eigen::Index n = contour.points.rows();
    contour.segment_normals = Points::Zero(n, 3);
    contour.segment_region = dataset::Integers::Zero(n);
    contour.segment_region.tail(5).setConstant(static_cast<std::int32_t>(dataset::SurfaceRegion::cap));
    // Control points: a few points of the outline, with the ellipse's normals.
    Points control(6, 3), normals(6, 3);
    for (Eigen::Index i = 0; i < 6; ++i)
    {
      control.row(i) = contour.points.row(8 * i);
      const double angle = 2 * std::numbers::pi * static_cast<double>(8 * i) / static_cast<double>(n);
      const Eigen::Vector2d across(std::cos(angle) / 24, std::sin(angle) / 18);
      normals.row(i) =
          (across.x() * series.geometry.column_direction + across.y() * series.geometry.row_direction).normalized();
    }
    return {0, {{"bladder", {contour}}}, {control}, {normals}};
  }
};
} // namespace

TEST(ImagePlane, LeadsToPixelsAndBack)
{
  const Series given;
  tracking::PixelPoints pixels(3, 2);
  pixels << 0, 0, 10.25, 3, 100, 127;
  const Points points = to_space(given.series.geometry, pixels);
  EXPECT_EQ(Eigen::Vector3d(points.row(0)), given.series.geometry.origin);
  EXPECT_NEAR((points.row(1) - points.row(0)).norm(), spacing * std::hypot(10.25, 3), 1e-12);
  EXPECT_LT((to_pixels(given.series.geometry, points) - pixels).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(distance_from_plane(given.series.geometry, points), 1e-12);
}

TEST(OutlineTracking, StartsFromPointsAMillimetreApartWithTheirRegions)
{
  const Series given;
  const std::vector<OrganContour> rest = rest_contours(given.exact.rest);
  ASSERT_EQ(rest.size(), 1u);
  const Eigen::Index n = rest[0].points.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    EXPECT_NEAR((rest[0].points.row((i + 1) % n) - rest[0].points.row(i)).norm(), 1, 0.1);
  // 5 of 66 segments are caps.
  const double share = (rest[0].region.array() == static_cast<int>(dataset::SurfaceRegion::cap)).cast<double>().mean();
  EXPECT_NEAR(share, 5.0 / 66, 0.02);
}

TEST(OutlineTracking, DrivesTheRegistrationWithControlPointsThatFollowTheOrgan)
{
  const Series given;
  const TrackedSeries tracked = track(given.series, rest_contours(given.exact.rest), {});
  const dataset::Observations driven = observations_of(tracked, given.exact, frames_per_increment);
  ASSERT_EQ(driven.frames.size(), static_cast<std::size_t>(n_increments));
  EXPECT_EQ(driven.frames.back().increment, n_increments);
  const Points truth = given.outline(n_increments * frames_per_increment);
  const Points &control = driven.frames.back().control_points[0];
  ASSERT_EQ(control.rows(), 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_LT((control.row(i) - truth.row(8 * i)).norm(), 0.75) << i; // half a pixel
}

TEST(OutlineTracking, TurnsTheNormalsWithTheOrgan)
{
  const Series given;
  const TrackedSeries tracked = track(given.series, rest_contours(given.exact.rest), {});
  const dataset::DynamicFrame last = observations_of(tracked, given.exact, frames_per_increment).frames.back();
  const double angle = std::atan(0.25); // rotation of the displacement's gradient
  const Eigen::Vector3d axis = given.series.geometry.column_direction.cross(given.series.geometry.row_direction);
  for (Eigen::Index i = 0; i < 6; ++i)
  {
    const Eigen::Vector3d rest = given.exact.rest.control_point_normals[0].row(i);
    const Eigen::Vector3d now = last.control_point_normals[0].row(i);
    EXPECT_NEAR(now.norm(), 1, 1e-12);
    EXPECT_LT(std::acos(now.dot(Eigen::AngleAxisd(angle, axis) * rest)), 0.1) << i;
  }
}

TEST(OutlineTracking, LeavesLostControlPointsOut)
{
  const Series given;
  TrackedSeries tracked = track(given.series, rest_contours(given.exact.rest), {});
  std::fill(tracked.frames.back()[0].is_lost.begin(), tracked.frames.back()[0].is_lost.begin() + 30, 1);
  const dataset::Observations driven = observations_of(tracked, given.exact, frames_per_increment);
  EXPECT_EQ(driven.frames[0].control_points[0].rows(), 6);
  EXPECT_LT(driven.frames.back().control_points[0].rows(), 6);
  EXPECT_GT(driven.frames.back().control_points[0].rows(), 2);
  EXPECT_EQ(driven.frames.back().control_point_normals[0].rows(), driven.frames.back().control_points[0].rows());
}

TEST(OutlineTracking, RefusesAnOutlineOffThePlaneOrOutsideTheImage)
{
  const Series given;
  std::vector<OrganContour> off = rest_contours(given.exact.rest), outside = off;
  off[0].points.rowwise() += 5 * given.exact.dyn_plane.normal.transpose();
  outside[0].points.rowwise() += 400 * given.series.geometry.column_direction.transpose();
  const auto refusal = [&](const std::vector<OrganContour> &contours)
  {
    try
    {
      track(given.series, contours, {});
    }
    catch (const InputError &problem)
    {
      return std::string(problem.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(off), testing::AllOf(HasSubstr("bladder"), HasSubstr("5.00 mm from the image plane")));
  EXPECT_THAT(refusal(outside), testing::AllOf(HasSubstr("bladder"), HasSubstr("outside the image of 128 x 128")));
}

TEST(OutlineTracking, RefusesFramesThatDoNotFitTheIncrements)
{
  const Series given;
  const TrackedSeries tracked = track(given.series, rest_contours(given.exact.rest), {});
  EXPECT_THROW(observations_of(tracked, given.exact, 3), InputError);
  EXPECT_THROW(observations_of(tracked, given.exact, 0), InputError);
}

TEST(OutlineTracking, WritesARowForEveryPointAndFrame)
{
  const Series given;
  const TrackedSeries tracked = track(given.series, rest_contours(given.exact.rest), {.tracker = "static"});
  const std::string text = tracked_point_csv(tracked);
  EXPECT_EQ(text.substr(0, text.find('\n')), "tracker,organ,contour,frame,point,x_mm,y_mm,z_mm,confidence,is_lost");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
            1 + static_cast<std::ptrdiff_t>(tracked.frames.size()) * tracked.rest[0].points.rows());
}

TEST(ContourErrorTable, AveragesTheFramesAfterTheFirst)
{
  const std::vector<ContourErrorRow> rows = {{"bezier", "bladder", 0, 9, 0, 0, 0, 0},
                                             {"bezier", "bladder", 1, 9, 0.25, 1, 0.5, 1},
                                             {"bezier", "bladder", 2, 9, 0.75, 3, 0.7, 2}};
  EXPECT_THAT(contour_error_table(rows),
              HasSubstr("bezier      bladder       0.50    0.75    2.00    0.60        1.50"));
  EXPECT_THAT(contour_error_csv(rows),
              HasSubstr("tracker,organ,frame,n_points,mean_mm,hd95_mm,normal_mm,tangential_mm\n"
                        "bezier,bladder,0,9,0,0,0,0\nbezier,bladder,1,9,0.25,1,0.5,1\n"));
}
} // namespace pelvireg::runner
