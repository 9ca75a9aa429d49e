#include "validation/runner/perturbation.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pelvireg::runner
{
namespace
{
using dataset::Perturbation;

/// A magnitude and the kind that it belongs to.
struct Magnitude
{
  const char *kind, *name;
  double value;
  double below; ///< exclusive
};

std::vector<Magnitude> magnitudes(const Perturbation &perturbation)
{
  const double any = HUGE_VAL, right_angle = std::numbers::pi / 2;
  return {{"modulus", "spread", perturbation.modulus_spread, 1},
          {"surface", "standard deviation (mm)", perturbation.surface_sd, any},
          {"surface", "correlation length (mm)", perturbation.surface_correlation_length, any},
          {"outline", "standard deviation (mm)", perturbation.outline_sd, any},
          {"plane", "offset's standard deviation (mm)", perturbation.plane_offset_sd, any},
          {"plane", "tilt's standard deviation (rad)", perturbation.plane_tilt_sd, right_angle}};
}

/// Two unit vectors that span the plane, from its normal alone.
std::array<Eigen::Vector3d, 2> axes_of(const dataset::Plane &plane)
{
  Eigen::Index least = 0;
  plane.normal.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d first = plane.normal.cross(Eigen::Vector3d::Unit(least)).normalized();
  return {first, plane.normal.cross(first).normalized()};
}

void require_positive_elements(const dataset::RegistrationBody &body, const Perturbation &perturbation, int sample)
{
  const auto point = [&](std::int32_t node) { return Eigen::Vector3d(body.points.row(node).transpose()); };
  const auto volume = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d)
  { return (point(b) - point(a)).cross(point(c) - point(a)).dot(point(d) - point(a)) / 6; };
  const auto require_positive = [&](double value, Eigen::Index element)
  {
    if (!(value > 0))
      throw InputError(
          fmt::format("register: surface noise of {} mm with a correlation length of {} mm inverts element "
                      "{} of '{}' in run {}; lower the standard deviation or raise the correlation length",
                      perturbation.surface_sd, perturbation.surface_correlation_length, element, body.name, sample));
  };
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
    require_positive(volume(body.tets(t, 0), body.tets(t, 1), body.tets(t, 2), body.tets(t, 3)), t);
  // The corner's three edges of VTK_HEXAHEDRON, right-handed.
  constexpr std::array<std::array<int, 4>, 8> corners = {
      {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};
  for (Eigen::Index h = 0; h < body.hexes.rows(); ++h)
    for (const auto &[a, b, c, d] : corners)
      require_positive(volume(body.hexes(h, a), body.hexes(h, b), body.hexes(h, c), body.hexes(h, d)), h);
}

void move_surfaces(dataset::RegistrationModel &model, const Perturbation &perturbation, int sample)
{
  const DisplacementNoise noise(perturbation.seed, sample, perturbation.surface_sd,
                                perturbation.surface_correlation_length);
  for (dataset::RegistrationBody &body : model.bodies)
  {
    for (auto point : body.points.rowwise())
      point += noise.at(point.transpose()).transpose();
    require_positive_elements(body, perturbation, sample);
  }
}

void move_control_points(dataset::Observations &observations, const Perturbation &perturbation, int sample)
{
  const auto [first, second] = axes_of(observations.dyn_plane);
  for (std::size_t frame = 0; frame < observations.frames.size(); ++frame)
    for (std::size_t organ = 0; organ < observations.frames[frame].control_points.size(); ++organ)
    {
      dataset::Points &points = observations.frames[frame].control_points[organ];
      for (Eigen::Index k = 0; k < points.rows(); ++k)
      {
        const auto [u, v] = normal_pair(perturbation.seed, {Stream::outline, sample, static_cast<std::uint32_t>(k),
                                                            static_cast<std::uint32_t>(frame << 8 | organ)});
        points.row(k) += perturbation.outline_sd * (u * first + v * second).transpose();
      }
    }
}

Eigen::Vector3d centroid_of(const dataset::DynamicFrame &frame)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Index count = 0;
  for (const dataset::Points &points : frame.control_points)
  {
    sum += points.colwise().sum().transpose();
    count += points.rows();
  }
  return count > 0 ? Eigen::Vector3d(sum / static_cast<double>(count)) : sum;
}

void move_plane(dataset::Observations &observations, const Perturbation &perturbation, int sample)
{
  if (observations.frames.empty())
    return;
  const Eigen::Isometry3d error =
      plane_error(perturbation, sample, observations.dyn_plane, centroid_of(observations.frames.front()));
  observations.dyn_plane.origin = error * observations.dyn_plane.origin;
  observations.dyn_plane.normal = (error.linear() * observations.dyn_plane.normal).normalized();
  for (dataset::DynamicFrame &frame : observations.frames)
  {
    for (dataset::Points &points : frame.control_points)
      points = ((points * error.linear().transpose()).rowwise() + error.translation().transpose()).eval();
    for (dataset::Points &normals : frame.control_point_normals)
      normals = (normals * error.linear().transpose()).eval();
  }
}
} // namespace

std::vector<std::string> perturbation_kinds()
{
  return {"modulus", "surface", "outline", "plane"};
}

std::vector<std::string> estimate_kinds()
{
  std::vector<std::string> kinds = perturbation_kinds();
  kinds.push_back(dataset::tracked_outlines);
  return kinds;
}

void require_usable(const Perturbation &perturbation)
{
  const std::vector<std::string> kinds = estimate_kinds();
  if (std::find(kinds.begin(), kinds.end(), perturbation.kind) == kinds.end())
    throw InputError(fmt::format("register: perturbation '{}' is unknown, allowed are: {}", perturbation.kind,
                                 fmt::join(kinds, ", ")));
  for (const Magnitude &magnitude : magnitudes(perturbation))
  {
    if (!(magnitude.value >= 0 && magnitude.value < magnitude.below))
      throw InputError(fmt::format("register: the {} of perturbation '{}' is {}, must be at least 0 and below {}",
                                   magnitude.name, magnitude.kind, magnitude.value, magnitude.below));
    if (magnitude.value != 0 && magnitude.kind != perturbation.kind)
      throw InputError(
          fmt::format("register: the {} of perturbation '{}' is {} where '{}' is perturbed, must be 0: one "
                      "thing is perturbed at a time",
                      magnitude.name, magnitude.kind, magnitude.value, perturbation.kind));
  }
  if (perturbation.kind == "surface" && !(perturbation.surface_correlation_length > 0))
    throw InputError("register: the correlation length of the surface noise is 0 mm, must be positive");
}

double modulus_factor(std::uint64_t seed, int sample, int body, double spread)
{
  if (sample == 0)
    return 1.0;
  const double unit = uniform_pair(seed, {Stream::modulus, sample, static_cast<std::uint32_t>(body), 0})[0];
  return 1.0 + spread * (2.0 * unit - 1.0);
}

DisplacementNoise::DisplacementNoise(std::uint64_t seed, int sample, double sd, double correlation_length)
    : amplitude_(sd * std::sqrt(2.0 / n_waves))
{
  for (std::uint32_t component = 0; component < 3; ++component)
    for (std::uint32_t wave = 0; wave < n_waves; ++wave)
    {
      // The spectrum of the correlation is normal with standard deviation 1 / L in every direction.
      const auto [kx, ky] = normal_pair(seed, {Stream::surface, sample, wave, 3 * component});
      const double kz = normal_pair(seed, {Stream::surface, sample, wave, 3 * component + 1})[0];
      wave_numbers_[component].row(wave) << kx, ky, kz;
      phases_[component][wave] =
          2 * std::numbers::pi * uniform_pair(seed, {Stream::surface, sample, wave, 3 * component + 2})[0];
    }
  for (WaveNumbers &numbers : wave_numbers_)
    numbers /= correlation_length;
}

Eigen::Vector3d DisplacementNoise::at(const Eigen::Vector3d &point) const
{
  Eigen::Vector3d displacement;
  for (std::size_t component = 0; component < 3; ++component)
    displacement[static_cast<Eigen::Index>(component)] =
        amplitude_ * ((wave_numbers_[component] * point).array() + phases_[component]).cos().sum();
  return displacement;
}

Eigen::Isometry3d plane_error(const Perturbation &perturbation, int sample, const dataset::Plane &plane,
                              const Eigen::Vector3d &centre)
{
  if (sample == 0)
    return Eigen::Isometry3d::Identity();
  const auto [about_first, about_second] = normal_pair(perturbation.seed, {Stream::plane, sample, 0, 0});
  const double along = normal_pair(perturbation.seed, {Stream::plane, sample, 1, 0})[0];
  const auto [first, second] = axes_of(plane);
  const Eigen::Vector3d tilt = perturbation.plane_tilt_sd * (about_first * first + about_second * second);
  Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
  if (const double angle = tilt.norm(); angle > 0)
    error.linear() = Eigen::AngleAxisd(angle, tilt / angle).toRotationMatrix();
  error.translation() = centre - error.linear() * centre + perturbation.plane_offset_sd * along * plane.normal;
  return error;
}

dataset::RegistrationModel perturbed(const dataset::RegistrationModel &model, const Perturbation &perturbation,
                                     int sample)
{
  dataset::RegistrationModel own = model;
  if (sample == 0)
    return own;
  if (perturbation.kind == "modulus")
    for (std::size_t body = 0; body < own.bodies.size(); ++body)
      own.bodies[body].youngs_modulus *=
          modulus_factor(perturbation.seed, sample, static_cast<int>(body), perturbation.modulus_spread);
  if (perturbation.kind == "surface")
    move_surfaces(own, perturbation, sample);
  return own;
}

dataset::Observations perturbed(const dataset::Observations &observations, const Perturbation &perturbation, int sample)
{
  dataset::Observations own = observations;
  if (sample == 0)
    return own;
  if (perturbation.kind == "outline")
    move_control_points(own, perturbation, sample);
  if (perturbation.kind == "plane")
    move_plane(own, perturbation, sample);
  return own;
}
} // namespace pelvireg::runner
