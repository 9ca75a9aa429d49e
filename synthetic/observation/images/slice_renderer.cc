#include "synthetic/observation/images/slice_renderer.h"

#include "synthetic/observation/images/body_background.h"
#include "synthetic/observation/images/random_field.h"
#include "synthetic/observation/images/uterus_layers.h"
#include "synthetic/observation/plane_intersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace pelvireg::observation
{
namespace
{
using dataset::SurfaceMesh;
using Eigen::Vector3d;

constexpr double profile_reach = 0.6; ///< thicknesses from the middle to where nothing is excited

/// The parts at one instant.
struct Instant
{
  std::vector<SurfaceMesh> outer, inner; ///< by body; inner is empty for solid ones
  std::optional<MotionField> around;     ///< for the background
  std::vector<MotionField> inside;       ///< by body; empty without texture
};

/// Share of each fine pixel inside a surface.
Raster coverage_of(const SurfaceMesh &surface, const std::string &name, const dataset::ImageGeometry &fine,
                   const dataset::Plane &plane)
{
  Raster coverage = Raster::Zero(fine.rows, fine.columns);
  for (const PlaneLoop &loop : intersect(surface, plane, name))
  {
    PixelLoop pixels;
    for (Eigen::Index i = 0; i < loop.contour.points.rows(); ++i)
      pixels.push_back(to_pixel(fine, loop.contour.points.row(i).transpose()));
    add_coverage(pixels, coverage);
  }
  return coverage.max(0.0f).min(1.0f);
}

/// Values at the pixels' centres to fine pixels, linear in between.
Raster refined_values(const Raster &coarse, int factor)
{
  Raster fine(coarse.rows() * factor, coarse.cols() * factor);
  const auto place = [&](Eigen::Index i, Eigen::Index n)
  {
    const double at = std::clamp((static_cast<double>(i) + 0.5) / factor - 0.5, 0.0, static_cast<double>(n - 1));
    const Eigen::Index cell = std::min<Eigen::Index>(static_cast<Eigen::Index>(at), std::max<Eigen::Index>(n - 2, 0));
    return std::pair(cell, static_cast<float>(at - static_cast<double>(cell)));
  };
  for (Eigen::Index row = 0; row < fine.rows(); ++row)
  {
    const auto [r, v] = place(row, coarse.rows());
    for (Eigen::Index column = 0; column < fine.cols(); ++column)
    {
      const auto [c, u] = place(column, coarse.cols());
      fine(row, column) = (1 - v) * ((1 - u) * coarse(r, c) + u * coarse(r, c + 1)) +
                          v * ((1 - u) * coarse(r + 1, c) + u * coarse(r + 1, c + 1));
    }
  }
  return fine;
}
} // namespace

std::vector<ProfileSample> slice_profile(double thickness, int n)
{
  std::vector<ProfileSample> samples;
  double sum = 0;
  for (int i = 0; i < n; ++i)
  {
    const double place = profile_reach * ((2.0 * i + 1) / n - 1); // in thicknesses
    const double ramp = std::clamp((std::abs(place) - 0.4) / 0.2, 0.0, 1.0);
    const double weight = std::pow(std::cos(0.5 * std::numbers::pi * ramp), 2);
    samples.push_back({place * thickness, weight});
    sum += weight;
  }
  for (ProfileSample &sample : samples)
    sample.weight /= sum;
  return samples;
}

struct SliceRenderer::Implementation
{
  const std::vector<TissueBody> &bodies;
  SliceSetting setting;
  std::size_t first, last;
  dataset::ImageGeometry fine;
  std::vector<ProfileSample> profile;
  std::vector<std::vector<FixedScenery>> scenery;  ///< by plane, then pixel
  std::vector<MotionField> around;                 ///< by increment from `first`
  std::vector<std::vector<MotionField>> inside;    ///< by increment, then body
  std::vector<std::optional<UterusLayers>> layers; ///< by body

  Implementation(const std::vector<TissueBody> &bodies_, const SliceSetting &setting_, std::size_t first_,
                 std::size_t last_)
      : bodies(bodies_), setting(setting_), first(first_), last(last_),
        fine(refined(setting.geometry, setting.oversampling)),
        profile(slice_profile(setting.thickness, setting.n_planes))
  {
    const double half = profile_reach * setting.thickness;
    for (std::size_t k = first; k <= last; ++k)
    {
      if (setting.has_background)
        around.emplace_back(setting.geometry, half, moved_points(bodies, k), true);
      inside.emplace_back();
      for (const TissueBody &body : bodies)
        inside.back().emplace_back(setting.geometry, half, moved_points(body, k), false);
    }
    for (const TissueBody &body : bodies)
      layers.push_back(body.tissue == Tissue::uterus ? std::optional(UterusLayers(body.rest.points)) : std::nullopt);
    if (setting.has_background)
      for (const ProfileSample &sample : profile)
        scenery.push_back(scenery_at(sample.offset));
  }

  Vector3d normal() const { return setting.geometry.column_direction.cross(setting.geometry.row_direction); }

  std::vector<FixedScenery> scenery_at(double offset) const
  {
    std::vector<FixedScenery> plane;
    for (int row = 0; row < setting.geometry.rows; ++row)
      for (int column = 0; column < setting.geometry.columns; ++column)
        plane.push_back(fixed_scenery(to_point(setting.geometry, column, row) + offset * normal(), setting.signals));
    return plane;
  }

  Instant instant_at(double increment) const
  {
    Instant instant;
    const double held = std::clamp(increment, static_cast<double>(first), static_cast<double>(last));
    const std::size_t a = static_cast<std::size_t>(held) - first, b = std::min(a + 1, last - first);
    const double share = held - static_cast<double>(a + first);
    if (setting.has_background)
      instant.around = MotionField::between(around[a], around[b], share);
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
      instant.outer.push_back(outer_surface(bodies[i], held));
      instant.inner.push_back(bodies[i].wall.size() > 0 ? inner_surface(bodies[i], held) : SurfaceMesh{});
      instant.inside.push_back(MotionField::between(inside[a][i], inside[b][i], share));
    }
    return instant;
  }

  /// Signal of the wall, or of a solid part, at a point whose rest position is `material`.
  double solid_signal(std::size_t body, const Vector3d &material) const
  {
    const double texture = setting.texture * tissue_texture(material, 10 + static_cast<std::uint32_t>(body));
    if (bodies[body].tissue == Tissue::uterus)
      return layers[body]->signal(material, setting.signals) * (1 + 0.3 * texture);
    if (bodies[body].tissue == Tissue::floor)
      return setting.signals.muscle * (1 + 0.5 * texture);
    return setting.signals.wall * (1 + 0.3 * texture);
  }

  double content_signal(std::size_t body) const
  {
    return bodies[body].tissue == Tissue::bladder ? setting.signals.urine : setting.signals.gel;
  }

  /// Adds a body's signal, and how much of each pixel it takes.
  void add_body(const Instant &instant, std::size_t body, const dataset::Plane &plane, Raster &signal,
                Raster &covered) const
  {
    const Raster outer = coverage_of(instant.outer[body], bodies[body].name, fine, plane);
    const Raster inner = bodies[body].wall.size() > 0
                             ? coverage_of(instant.inner[body], bodies[body].name, fine, plane).min(outer).eval()
                             : Raster::Zero(fine.rows, fine.columns).eval();
    const Vector3d shift = plane.origin - fine.origin;
    for (Eigen::Index row = 0; row < outer.rows(); ++row)
      for (Eigen::Index column = 0; column < outer.cols(); ++column)
        if (const float share = outer(row, column); share > 0)
        {
          const float lumen = inner(row, column);
          double value = lumen * content_signal(body);
          if (lumen < share)
          {
            const Vector3d position = to_point(fine, static_cast<double>(column), static_cast<double>(row)) + shift;
            value += (share - lumen) * solid_signal(body, position - instant.inside[body].displacement_at(position));
          }
          signal(row, column) += static_cast<float>(value);
          covered(row, column) += share;
        }
  }

  Raster background(const Instant &instant, std::size_t plane) const
  {
    Raster values(setting.geometry.rows, setting.geometry.columns);
    std::size_t pixel = 0;
    for (int row = 0; row < setting.geometry.rows; ++row)
      for (int column = 0; column < setting.geometry.columns; ++column)
      {
        const FixedScenery &fixed = scenery[plane][pixel++];
        double value = fixed.bone * fixed.bone_signal;
        if (fixed.inside > 0 && fixed.bone < 1)
        {
          const Vector3d position = to_point(setting.geometry, column, row) + profile[plane].offset * normal();
          value += (1 - fixed.bone) *
                   soft_tissue(position - instant.around->displacement_at(position), fixed.skin_depth, setting.signals);
        }
        values(row, column) = static_cast<float>(fixed.inside * value);
      }
    return refined_values(values, setting.oversampling);
  }

  Raster plane_image(const Instant &instant, std::size_t index) const
  {
    const dataset::Plane plane{fine.origin + profile[index].offset * normal(), normal()};
    Raster signal = Raster::Zero(fine.rows, fine.columns), covered = signal;
    for (std::size_t body = 0; body < bodies.size(); ++body)
      add_body(instant, body, plane, signal, covered);
    signal = (covered > 1).select(signal / covered.max(1.0f), signal); // parts that press into each other share
    if (setting.has_background)
      signal += (1 - covered).max(0.0f) * background(instant, index);
    return signal;
  }
};

SliceRenderer::SliceRenderer(const std::vector<TissueBody> &bodies, const SliceSetting &setting, std::size_t first,
                             std::size_t last)
    : implementation_(std::make_unique<Implementation>(bodies, setting, first, last))
{
}

SliceRenderer::~SliceRenderer() = default;

Raster SliceRenderer::at(double increment) const
{
  const Instant instant = implementation_->instant_at(increment);
  Raster image = Raster::Zero(implementation_->fine.rows, implementation_->fine.columns);
  for (std::size_t i = 0; i < implementation_->profile.size(); ++i)
    if (implementation_->profile[i].weight > 0)
      image += static_cast<float>(implementation_->profile[i].weight) * implementation_->plane_image(instant, i);
  return image;
}
} // namespace pelvireg::observation
