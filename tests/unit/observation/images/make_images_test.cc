// The images of a small pelvis of balls: frames, planes, places, bytes.
#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/make_images.h"
#include "synthetic/observation/images/raster.h"
#include "tests/unit/observation/images/sample_images.h"
#include "tests/unit/observation/surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::observation::test
{
namespace
{
using ::testing::HasSubstr;

/// Four balls behind and above each other; all move by 2 mm down and 1 mm back an increment, two increments.
struct BallPelvis
{
  dataset::Anatomy anatomy;
  dataset::Truth truth;

  BallPelvis()
  {
    anatomy.case_name = truth.case_name = "balls";
    anatomy.dyn_plane = {{2, 40, 40}, Vector3d(1, 0.05, 0).normalized()};
    anatomy.n_slices_each_side = 1;
    truth.increments.resize(2);
    int i = 0;
    for (const std::string &organ : dataset::organ_names)
    {
      dataset::SurfaceMesh mesh = sphere(14, 4);
      mesh.points.rowwise() += Eigen::RowVector3d(0, 10 + 36 * (i % 2), 20 + 36 * (i / 2));
      ++i;
      dataset::Points motion(mesh.points.rows(), 3);
      motion.rowwise() = Eigen::RowVector3d(0, 1, -2);
      truth.surfaces.push_back({organ, mesh, {motion, 2 * motion}});
      if (organ != "uterus")
      {
        dataset::ReferenceShell shell;
        shell.name = organ;
        shell.midsurface = mesh.points;
        shell.directors = dataset::Points::Zero(mesh.points.rows(), 3);
        shell.thickness = Eigen::VectorXd::Constant(mesh.points.rows(), 3);
        anatomy.reference.shells.push_back(shell);
      }
    }
  }
};

ImageOptions small_options()
{
  return {.matrix = 64, .pixel = 3, .snr = 0, .static_snr = 0, .frames_per_increment = 3, .segments = 1};
}

/// The lower ball in front.
Vector3d bladder_centre(int frame)
{
  return Vector3d(0, 10, 20) + frame / 3.0 * Vector3d(0, 1, -2);
}

/// Centre of the urine in a frame, mm. A pixel counts in full from 0.8 on and not at all up to 0.5 (wall 0.27, urine
/// 1), so that the coils' shading inside has no weight: weighed by brightness it would shift the centre by 0.5 mm. Only
/// pixels within 13.5 mm of where the bladder should be count: its lumen, 11 mm, and wall, 14 mm; not the fat around
/// it, which the coils make as bright.
Eigen::Vector2d urine_centre(const dataset::ImageSeries &series, int frame)
{
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double sum = 0;
  const dataset::ImageGeometry &geometry = series.geometry;
  const Eigen::Vector2d near = to_pixel(geometry, bladder_centre(frame));
  for (int row = 0; row < geometry.rows; ++row)
    for (int column = 0; column < geometry.columns; ++column)
      if ((Eigen::Vector2d(column, row) - near).norm() * geometry.spacing[0] < 13.5)
      {
        const double value =
            series.pixels[static_cast<std::size_t>((frame * geometry.rows + row) * geometry.columns + column)];
        const double weight = std::clamp((value - 0.5) / 0.3, 0.0, 1.0);
        moment += weight * Eigen::Vector2d(column, row);
        sum += weight;
      }
  return geometry.spacing[0] * moment / sum;
}
} // namespace

TEST(Images, HaveAFrameAtRestAndAMultipleAnIncrement)
{
  const BallPelvis pelvis;
  const Images images = make_images(pelvis.anatomy, pelvis.truth, small_options());
  ASSERT_EQ(images.dyn.times_s.size(), 7u);
  EXPECT_EQ(images.dyn.times_s[6], 1.5); // 4 frames a second
  EXPECT_EQ(images.ffe.slices, 3);
  EXPECT_EQ(images.tse.geometry.columns, 96);
  EXPECT_EQ(images.tse.geometry.spacing[0], 1.5);
}

TEST(Images, LieInTheirPlanes)
{
  const BallPelvis pelvis;
  const Images images = make_images(pelvis.anatomy, pelvis.truth, small_options());
  const auto &plane = pelvis.anatomy.dyn_plane;
  for (const auto &[column, row] : {std::pair(0, 0), std::pair(63, 0), std::pair(12, 63)})
  {
    EXPECT_NEAR((to_point(images.dyn.geometry, column, row) - plane.origin).dot(plane.normal), 0, 1e-9);
    EXPECT_NEAR((to_point(images.ffe.geometry, column, row) - plane.origin).dot(plane.normal), -6, 1e-9); // slice -1
  }
  EXPECT_LT((images.ffe.slice_step - 6 * plane.normal).norm(), 1e-12);
  EXPECT_GT(images.dyn.geometry.column_direction.y(), 0.99);
  EXPECT_NEAR(images.dyn.geometry.row_direction.z(), -1, 1e-9);
}

TEST(Images, ShowTheOrgansWhereTheTruthHasThem)
{
  const BallPelvis pelvis;
  ImageOptions options = small_options();
  options.matrix = 128;
  options.pixel = 1.5;
  const dataset::ImageSeries dyn = make_images(pelvis.anatomy, pelvis.truth, options).dyn;
  // A tenth of a pixel: the coils' shading, 4 % over the lumen, shifts where an edge 2 pixels wide passes a brightness.
  for (const int frame : {0, 1, 3, 6})
    EXPECT_LT((urine_centre(dyn, frame) - 1.5 * to_pixel(dyn.geometry, bladder_centre(frame))).norm(), 0.15) << frame;
}

TEST(Images, AreTheSameBytesForAnyNumberOfThreads)
{
  const BallPelvis pelvis;
  ImageOptions options = small_options();
  options.snr = 10;
  options.segments = 3;
  const Images one = make_images(pelvis.anatomy, pelvis.truth, options);
  options.n_threads = 2;
  const Images two = make_images(pelvis.anatomy, pelvis.truth, options);
  EXPECT_EQ(one.dyn.pixels, two.dyn.pixels);
  EXPECT_EQ(one.tse.pixels, two.tse.pixels);
  EXPECT_EQ(one.ffe.pixels, two.ffe.pixels);
}

TEST(Images, BlurWhatMovesWithinAFrame)
{
  const BallPelvis pelvis;
  ImageOptions options = small_options();
  const Images still = make_images(pelvis.anatomy, pelvis.truth, options);
  options.segments = 5;
  const Images moving = make_images(pelvis.anatomy, pelvis.truth, options);
  const std::size_t size = 64 * 64;
  double in_motion = 0;
  for (std::size_t i = 0; i < size; ++i)
    in_motion = std::max(
        in_motion, std::abs(static_cast<double>(still.dyn.pixels[3 * size + i] - moving.dyn.pixels[3 * size + i])));
  EXPECT_GT(in_motion, 1e-3);                                                        // single precision has 1e-6
  EXPECT_LT((urine_centre(moving.dyn, 3) - urine_centre(still.dyn, 3)).norm(), 0.1); // mm: the time is the middle
}

TEST(Images, RefuseOptionsOutOfRangeAndAnotherCase)
{
  BallPelvis pelvis;
  const auto refusal = [&](auto &&change)
  {
    ImageOptions options = small_options();
    change(options);
    return refusal_of([&] { make_images(pelvis.anatomy, pelvis.truth, options); });
  };
  EXPECT_THAT(refusal([](ImageOptions &o) { o.matrix = 63; }), HasSubstr("matrix"));
  EXPECT_THAT(refusal([](ImageOptions &o) { o.snr = -1; }), HasSubstr("signal-to-noise"));
  EXPECT_THAT(refusal([](ImageOptions &o) { o.snr = std::nan(""); }), HasSubstr("signal-to-noise"));
  EXPECT_THAT(refusal([](ImageOptions &o) { o.segments = 2; }), HasSubstr("odd"));
  EXPECT_THAT(refusal([](ImageOptions &o) { o.pixel = 9; }), HasSubstr("pixel"));
  pelvis.truth.case_name = "other";
  EXPECT_THAT(refusal([](ImageOptions &) {}), HasSubstr("must be of one case"));
}
} // namespace pelvireg::observation::test
