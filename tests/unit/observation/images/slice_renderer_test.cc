// Rendered slices against closed forms: areas, places, edges; texture that goes with the tissue.
#include "synthetic/observation/images/slice_renderer.h"
#include "tests/unit/observation/images/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::observation::test
{
namespace
{
using std::numbers::pi;

SliceSetting setting_of(double thickness, int n_planes)
{
  SliceSetting setting{.geometry = sagittal(64, 1.5, {0, 0, 0}), .thickness = thickness};
  setting.has_background = false;
  setting.texture = 0;
  setting.n_planes = n_planes;
  return setting;
}

Eigen::Vector2d centroid(const Raster &image)
{
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (Eigen::Index row = 0; row < image.rows(); ++row)
    for (Eigen::Index column = 0; column < image.cols(); ++column)
      moment += static_cast<double>(image(row, column)) *
                Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
  return moment / static_cast<double>(image.sum());
}

/// Share of the slice's profile below the offset `t` thicknesses from the middle: integral of 1 and cos^2 ramps.
double profile_below(double t)
{
  const auto ramp = [](double s) // integral from 0 to s of cos^2(pi s / 0.4), s up to 0.2
  { return 0.5 * s + 0.2 / pi * std::sin(pi * s / 0.2) * 0.5; };
  const double a = std::abs(t);
  const double half = std::min(a, 0.4) + (a > 0.4 ? ramp(std::min(a, 0.6) - 0.4) : 0);
  return t < 0 ? 0.5 - half : 0.5 + half; // the whole is 2 (0.4 + 0.1) = 1
}
} // namespace

TEST(SliceProfile, HasTheThicknessAsItsFullWidthAtHalfMaximum)
{
  const auto profile = slice_profile(8, 1201);
  double sum = 0, above_half = 0, most = 0;
  for (const ProfileSample &sample : profile)
    most = std::max(most, sample.weight);
  for (const ProfileSample &sample : profile)
  {
    sum += sample.weight;
    above_half += sample.weight > 0.5 * most ? 1.2 * 8 / 1201 : 0;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(above_half, 8, 0.02);
}

TEST(Slice, OfABallHasTheBallsAreaAndPlace)
{
  // Solid ball, 20 mm; thin slice through its middle: a disk.
  const std::vector<TissueBody> bodies = {solid_ball(20, {0, 3.3, -2.7})};
  SliceSetting setting = setting_of(0.01, 1);
  const Raster image = SliceRenderer(bodies, setting, 0, 0).at(0);
  const double pixel_area = std::pow(1.5 / setting.oversampling, 2);
  // Of the facets: a section of the polyhedron of level 5 is smaller than the circle by less than 0.1 %.
  const double area = static_cast<double>(image.sum()) * pixel_area / bssfp_signals.muscle;
  EXPECT_NEAR(area, pi * 400, 0.0015 * pi * 400);
  const Eigen::Vector2d expected = to_pixel(refined(setting.geometry, setting.oversampling), {0, 3.3, -2.7});
  EXPECT_LT((centroid(image) - expected).norm() * 0.75, 0.01); // mm
}

TEST(Slice, ThickThroughABallAveragesItsSections)
{
  const std::vector<TissueBody> bodies = {solid_ball(20, {4, 0, 0})};
  const SliceSetting setting = setting_of(8, 41);
  const Raster image = SliceRenderer(bodies, setting, 0, 0).at(0);
  const double area = static_cast<double>(image.sum()) * 0.75 * 0.75 / bssfp_signals.muscle;
  // Integral over the profile p of pi (R^2 - (d - 4)^2) = pi (R^2 - 16 - variance of p); the variance of the profile
  // in thicknesses: 2 [0.4^3/3 + integral over the ramp].
  double variance = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i)
  {
    const double t = 0.6 * (i + 0.5) / n, ramp = std::max(0.0, (t - 0.4) / 0.2);
    variance += 2 * 0.6 / n * t * t * std::pow(std::cos(0.5 * pi * ramp), 2);
  }
  EXPECT_NEAR(area, pi * (400 - 16 - 64 * variance), 0.002 * pi * 400);
}

TEST(Slice, BlursAnObliqueEdgeAsItsProfileSays)
{
  // A block whose face rises by 1 mm in y for every mm in x: seen through 8 mm, the edge is 8 mm wide and more.
  const std::vector<TissueBody> bodies = {slanted_block(30, 1.0)};
  const SliceSetting setting = setting_of(8, 61);
  const dataset::ImageGeometry fine = refined(setting.geometry, setting.oversampling);
  const Raster image = SliceRenderer(bodies, setting, 0, 0).at(0) / static_cast<float>(bssfp_signals.muscle);
  const Eigen::Index middle = image.rows() / 2;
  for (Eigen::Index column = 40; column < 88; ++column)
  {
    const double y = to_point(fine, static_cast<double>(column), static_cast<double>(middle)).y();
    // Inside where y < x: planes at x > y count. Half a pixel's blur (0.375 mm) and half a plane's step (0.08 mm)
    // against the profile's slope of 1 / 8 per mm at most.
    EXPECT_NEAR(image(middle, column), 1 - profile_below(y / 8), 0.02) << y;
  }
}

TEST(Slice, ShowsWallsAndWhatTheyEnclose)
{
  const std::vector<TissueBody> bodies = {hollow_ball(Tissue::bladder, 20, 3, {0, 0, 0})};
  const Raster image = SliceRenderer(bodies, setting_of(0.01, 1), 0, 0).at(0);
  const Eigen::Index middle = image.rows() / 2;
  EXPECT_NEAR(image(middle, middle), bssfp_signals.urine, 1e-5);
  EXPECT_NEAR(image(middle, middle + static_cast<Eigen::Index>(18.5 / 0.75)), bssfp_signals.wall, 1e-5);
  EXPECT_NEAR(image(middle, middle + static_cast<Eigen::Index>(22 / 0.75)), 0, 1e-5);
  const double urine = (static_cast<double>(image.sum()) * 0.5625 - pi * (400 - 289) * bssfp_signals.wall) / (pi * 289);
  EXPECT_NEAR(urine, 1, 0.01); // inner radius 17 mm
}

TEST(Slice, MovesWithTheBodyBySubPixels)
{
  std::vector<TissueBody> bodies = {solid_ball(15, {0, 0, 0})};
  translate(bodies[0], {0, 1.1, -0.7});
  const SliceRenderer renderer(bodies, setting_of(6, 7), 0, 1);
  const Eigen::Vector2d rest = centroid(renderer.at(0));
  for (const double share : {0.25, 0.5, 1.0})
  {
    const Eigen::Vector2d moved = 0.75 * (centroid(renderer.at(share)) - rest); // mm; rows run down
    EXPECT_LT((moved - share * Eigen::Vector2d(1.1, 0.7)).norm(), 0.01) << share;
  }
}

TEST(Slice, CarriesTheTextureWithARigidMotion)
{
  // Two pixels back, one down: every fine pixel of the moved body shows what the rest body showed there.
  std::vector<TissueBody> bodies = {solid_ball(25, {0, 0, 0})};
  translate(bodies[0], {0, 3.0, -1.5});
  SliceSetting setting = setting_of(6, 5);
  setting.texture = 1;
  const SliceRenderer renderer(bodies, setting, 0, 1);
  const Raster rest = renderer.at(0), moved = renderer.at(1);
  double largest = 0, contrast = 0;
  const Eigen::Index size = rest.rows();
  for (Eigen::Index row = 0; row + 2 < size; ++row)
    for (Eigen::Index column = 0; column + 4 < size; ++column)
    {
      largest = std::max(largest, static_cast<double>(std::abs(moved(row + 2, column + 4) - rest(row, column))));
      contrast = std::max(contrast, static_cast<double>(std::abs(moved(row, column) - rest(row, column))));
    }
  EXPECT_LT(largest, 1e-3 * bssfp_signals.muscle);
  EXPECT_GT(contrast, 0.3 * bssfp_signals.muscle);
}

TEST(Slice, HasABackgroundThatMovesNearTheBodyAndRestsFarAway)
{
  std::vector<TissueBody> bodies = {solid_ball(25, {0, 40, 40})};
  translate(bodies[0], {0, 6, 0});
  SliceSetting setting = setting_of(6, 1);
  setting.geometry = sagittal(96, 3, {0, 40, 60});
  setting.has_background = true;
  const SliceRenderer renderer(bodies, setting, 0, 1);
  const Raster change = (renderer.at(1) - renderer.at(0)).abs();
  const dataset::ImageGeometry fine = refined(setting.geometry, setting.oversampling);
  const auto around = [&](const Eigen::Vector3d &point)
  {
    const Eigen::Vector2d pixel = to_pixel(fine, point);
    return change.block(static_cast<Eigen::Index>(pixel.y()) - 3, static_cast<Eigen::Index>(pixel.x()) - 3, 7, 7)
        .mean();
  };
  EXPECT_GT(around({0, 40, 8}), 0.01);     // fat, 7 mm under the ball
  EXPECT_LT(around({0, 150, 110}), 0.003); // sacrum: bone stays
}
} // namespace pelvireg::observation::test
