#include "validation/runner/perturbation.h"

#include "synthetic/dataset/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

namespace pelvireg::runner
{
namespace
{
using dataset::Perturbation;

constexpr double degree = std::numbers::pi / 180;
const Perturbation outline_noise{.kind = "outline", .seed = 3, .outline_sd = 0.8};
const Perturbation plane_noise{.kind = "plane", .seed = 3, .plane_offset_sd = 2, .plane_tilt_sd = 2 * degree};
const Perturbation surface_noise{.kind = "surface", .seed = 3, .surface_sd = 1.5, .surface_correlation_length = 10};

std::string refusal_of(const Perturbation &perturbation)
{
  try
  {
    require_usable(perturbation);
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "not refused";
}

/// A plane in a general position, and 40 control points of every organ in it, in each of five frames.
dataset::Observations observations()
{
  dataset::Observations content;
  content.dyn_plane.origin = {3, 30, 40};
  content.dyn_plane.normal = Eigen::Vector3d(0.95, -0.1, 0.2).normalized();
  const Eigen::Vector3d first = content.dyn_plane.normal.unitOrthogonal(),
                        second = content.dyn_plane.normal.cross(first);
  content.frames.resize(5);
  for (dataset::DynamicFrame &frame : content.frames)
    for (std::size_t organ = 0; organ < 4; ++organ)
    {
      dataset::Points points(40, 3), normals(40, 3);
      for (int k = 0; k < 40; ++k)
      {
        const Eigen::Vector3d normal = std::cos(k) * first + std::sin(k) * second;
        normals.row(k) = normal.transpose();
        points.row(k) = (content.dyn_plane.origin + 20 * normal).transpose();
      }
      frame.control_points.push_back(points);
      frame.control_point_normals.push_back(normals);
    }
  return content;
}

/// A bar of cubes of 2 mm, each of six tetrahedra or one hexahedron.
dataset::RegistrationModel two_bars(int n_cells)
{
  dataset::RegistrationBody tets, hexes;
  tets.name = "vagina";
  hexes.name = "ligaments";
  tets.points.resize(4 * (n_cells + 1), 3);
  for (int i = 0; i <= n_cells; ++i)
    tets.points.middleRows(4 * i, 4) << 2 * i, 0, 0, 2 * i, 2, 0, 2 * i, 2, 2, 2 * i, 0, 2;
  hexes.points = tets.points;
  tets.tets.resize(6 * n_cells, 4);
  hexes.hexes.resize(n_cells, 8);
  for (int i = 0; i < n_cells; ++i)
  {
    const int a = 4 * i;
    hexes.hexes.row(i) << a, a + 4, a + 5, a + 1, a + 3, a + 7, a + 6, a + 2;
    const std::array<int, 8> c = {a, a + 4, a + 5, a + 1, a + 3, a + 7, a + 6, a + 2};
    tets.tets.middleRows(6 * i, 6) << c[0], c[1], c[2], c[6], c[0], c[2], c[3], c[6], c[0], c[3], c[7], c[6], c[0],
        c[7], c[4], c[6], c[0], c[4], c[5], c[6], c[0], c[5], c[1], c[6];
  }
  dataset::RegistrationModel model;
  model.bodies = {tets, hexes};
  return model;
}

TEST(Perturbation, RefusesWhatIsOutOfRangeOrOfAnotherKind)
{
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal_of({.kind = "weather"}),
              HasSubstr("'weather' is unknown, allowed are: modulus, surface, outline"));
  for (const double spread : {1.0, -1e-12, std::nan("")})
    EXPECT_THAT(refusal_of({.modulus_spread = spread}), HasSubstr("must be at least 0 and below 1"));
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
  {
    EXPECT_NE(refusal_of({.kind = "outline", .outline_sd = bad}), "not refused");
    EXPECT_NE(refusal_of({.kind = "surface", .surface_sd = bad, .surface_correlation_length = 1}), "not refused");
    EXPECT_NE(refusal_of({.kind = "plane", .plane_offset_sd = bad}), "not refused");
    EXPECT_NE(refusal_of({.kind = "plane", .plane_tilt_sd = bad}), "not refused");
  }
  EXPECT_THAT(refusal_of({.kind = "surface", .surface_sd = 1}), HasSubstr("correlation length"));
  EXPECT_THAT(refusal_of({.kind = "outline", .modulus_spread = 0.1, .outline_sd = 1}), HasSubstr("one thing"));
  for (const Perturbation &usable : {outline_noise, plane_noise, surface_noise, Perturbation{.modulus_spread = 0.1}})
    EXPECT_EQ(refusal_of(usable), "not refused");
}

TEST(Perturbation, KnowsOutlinesOfImagesAsAnEstimateThatNothingIsDrawnFor)
{
  const Perturbation images{.kind = dataset::tracked_outlines};
  EXPECT_NO_THROW(require_usable(images));
  dataset::Estimate estimate;
  estimate.condition = "full";
  estimate.perturbation = images;
  EXPECT_EQ(estimate.label(), "full_images");
  const std::vector<std::string> kinds = perturbation_kinds();
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), dataset::tracked_outlines), 0);
}

TEST(Perturbed, LeavesTheNominalRunAlone)
{
  const dataset::Observations given = observations();
  for (const Perturbation &perturbation : {outline_noise, plane_noise})
  {
    const dataset::Observations own = perturbed(given, perturbation, 0);
    EXPECT_EQ(own.frames[2].control_points, given.frames[2].control_points);
    EXPECT_EQ(own.dyn_plane.normal, given.dyn_plane.normal);
    EXPECT_NE(perturbed(given, perturbation, 1).frames[2].control_points, given.frames[2].control_points);
  }
  const dataset::RegistrationModel model = two_bars(4);
  EXPECT_EQ(perturbed(model, surface_noise, 0).bodies[0].points, model.bodies[0].points);
  EXPECT_NE(perturbed(model, surface_noise, 1).bodies[0].points, model.bodies[0].points);
  EXPECT_EQ(perturbed(model, outline_noise, 1).bodies[0].points, model.bodies[0].points) << "one thing at a time";
}

TEST(OutlineNoise, LiesInThePlaneWithTheStatedDeviationAndIndependentFramesAndPoints)
{
  const dataset::Observations given = observations();
  const Eigen::Vector3d first = given.dyn_plane.normal.unitOrthogonal(), second = given.dyn_plane.normal.cross(first);
  double along_first = 0, along_second = 0, across = 0, between_frames = 0, between_points = 0;
  int n = 0;
  for (int sample = 1; sample <= 20; ++sample)
  {
    const dataset::Observations own = perturbed(given, outline_noise, sample);
    for (std::size_t frame = 0; frame < 5; ++frame)
      for (std::size_t organ = 0; organ < 4; ++organ)
      {
        const auto noise_of = [&](std::size_t f)
        { return dataset::Points(own.frames[f].control_points[organ] - given.frames[f].control_points[organ]); };
        const dataset::Points noise = noise_of(frame), other = noise_of((frame + 1) % 5);
        EXPECT_LE((noise * given.dyn_plane.normal).cwiseAbs().maxCoeff(), 1e-12);
        along_first += (noise * first).squaredNorm();
        along_second += (noise * second).squaredNorm();
        across += (noise * first).dot(noise * second);
        between_frames += noise.cwiseProduct(other).sum();
        between_points += noise.topRows(39).cwiseProduct(noise.bottomRows(39)).sum();
        n += 40;
      }
  }
  const double variance = 0.8 * 0.8, standard_error = variance * std::sqrt(2.0 / n);
  for (const double squares : {along_first, along_second})
    EXPECT_NEAR(squares / n, variance, 4 * standard_error);
  EXPECT_NEAR(across / n, 0, 4 * standard_error);
  EXPECT_NEAR(between_frames / n, 0, 4 * standard_error);
  EXPECT_NEAR(between_points / n, 0, 4 * standard_error);
}

TEST(PlaneNoise, MovesPlaneAndPointsRigidlyByTheStatedDeviations)
{
  const dataset::Observations given = observations();
  constexpr int n = 4000;
  double tilt_squares = 0, offset_squares = 0;
  for (int sample = 1; sample <= n; ++sample)
  {
    const Eigen::Isometry3d error =
        plane_error(plane_noise, sample, given.dyn_plane, given.dyn_plane.origin + Eigen::Vector3d(5, 6, 7));
    ASSERT_NEAR(error.linear().determinant(), 1, 1e-12);
    const Eigen::Vector3d centre = given.dyn_plane.origin + Eigen::Vector3d(5, 6, 7);
    const Eigen::Vector3d moved = error * centre - centre;
    ASSERT_LE(moved.cross(given.dyn_plane.normal).norm(), 1e-10) << "the centre moves along the normal alone";
    offset_squares += moved.squaredNorm();
    const double angle = std::acos(std::min(1.0, given.dyn_plane.normal.dot(error.linear() * given.dyn_plane.normal)));
    tilt_squares += angle * angle;
  }
  EXPECT_NEAR(offset_squares / n, 4, 4 * 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(tilt_squares / n / (degree * degree), 8, 4 * 8 / std::sqrt(static_cast<double>(n))); // two axes of 2 deg

  const dataset::Observations own = perturbed(given, plane_noise, 1);
  EXPECT_GT((own.dyn_plane.normal - given.dyn_plane.normal).norm(), 1e-3);
  const dataset::Points &points = own.frames[3].control_points[2], &normals = own.frames[3].control_point_normals[2];
  for (int k = 0; k < 40; ++k)
  {
    EXPECT_NEAR((points.row(k).transpose() - own.dyn_plane.origin).dot(own.dyn_plane.normal), 0, 1e-12);
    EXPECT_NEAR(normals.row(k).dot(own.dyn_plane.normal.transpose()), 0, 1e-12);
    EXPECT_NEAR((points.row(k) - points.row(0)).norm(),
                (given.frames[3].control_points[2].row(k) - given.frames[3].control_points[2].row(0)).norm(), 1e-12);
  }
}

TEST(DisplacementNoise, HasTheStatedDeviationAndCorrelation)
{
  // Over many fields, at pairs of points r apart: E[u(x) u(x + r)] = sd^2 exp(-r^2 / (2 L^2)).
  constexpr int n = 3000;
  const Eigen::Vector3d point(12, -40, 77), direction = Eigen::Vector3d(1, 2, -2) / 3;
  for (const double distance : {0.0, 5.0, 10.0, 30.0})
  {
    Eigen::Vector3d products = Eigen::Vector3d::Zero();
    double across = 0;
    for (int sample = 1; sample <= n; ++sample)
    {
      const DisplacementNoise noise(9, sample, 1.5, 10);
      const Eigen::Vector3d here = noise.at(point), there = noise.at(point + distance * direction);
      products += here.cwiseProduct(there);
      across += here.x() * there.y();
    }
    const double variance = 1.5 * 1.5, tolerance = 4 * variance * std::sqrt(2.0 / n);
    for (int component = 0; component < 3; ++component)
      EXPECT_NEAR(products[component] / n, variance * std::exp(-distance * distance / 200), tolerance) << distance;
    EXPECT_NEAR(across / n, 0, tolerance) << "components are independent";
  }
}

TEST(SurfaceNoise, MovesCoincidentNodesTogetherAndKeepsElementsPositive)
{
  const dataset::RegistrationModel model = two_bars(30);
  for (int sample = 1; sample <= 20; ++sample)
  {
    const dataset::RegistrationModel own = perturbed(model, surface_noise, sample);
    EXPECT_EQ(own.bodies[0].points, own.bodies[1].points) << "an attachment stays closed";
    EXPECT_GT((own.bodies[0].points - model.bodies[0].points).rowwise().norm().maxCoeff(), 0.5);
  }
}

TEST(SurfaceNoise, RefusesNoiseThatInvertsAnElement)
{
  Perturbation rough = surface_noise;
  rough.surface_correlation_length = 0.5; // far below the elements' 2 mm
  dataset::RegistrationModel model = two_bars(30);
  for (const std::string body : {"vagina", "ligaments"})
  {
    try
    {
      perturbed(model, rough, 1);
      FAIL() << "no refusal";
    }
    catch (const InputError &error)
    {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("of '" + body + "' in run 1"));
    }
    model.bodies.erase(model.bodies.begin());
  }
}

TEST(ModulusFactor, OfTheNominalRunIsOne)
{
  EXPECT_EQ(modulus_factor(1, 0, 3, 0.10), 1.0);
}

TEST(ModulusFactor, IsUniformWithinTheSpread)
{
  constexpr int n = 20000;
  double sum = 0, sum_of_squares = 0, least = 2, largest = 0;
  for (int i = 1; i <= n; ++i)
  {
    const double factor = modulus_factor(7, i, i % 5, 0.10);
    ASSERT_GE(factor, 0.9);
    ASSERT_LE(factor, 1.1);
    sum += factor - 1;
    sum_of_squares += (factor - 1) * (factor - 1);
    least = std::min(least, factor);
    largest = std::max(largest, factor);
  }
  const double sd = 0.10 / std::sqrt(3.0);
  EXPECT_NEAR(sum / n, 0, 4 * sd / std::sqrt(n)); // four standard errors
  EXPECT_NEAR(std::sqrt(sum_of_squares / n), sd, 0.02 * sd);
  EXPECT_LE(least, 0.9001);
  EXPECT_GE(largest, 1.0999);
}

TEST(ModulusFactor, DependsOnSeedSampleAndBody)
{
  const double factor = modulus_factor(1, 2, 3, 0.10);
  EXPECT_NE(factor, modulus_factor(2, 2, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1ull << 32 | 1, 2, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 3, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 2, 2, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 3, 2, 0.10)) << "sample and body must not be mixed up";
}
} // namespace
} // namespace pelvireg::runner
