#include "validation/runner/truth_organ.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/enclosed_volume.h"
#include "validation/metrics/material_error.h"
#include "validation/metrics/offset_bins.h"
#include "validation/metrics/rigid_rotation.h"
#include "validation/metrics/section_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pelvireg::runner
{
namespace
{
using dataset::Points;

TruthIncrement prepare_increment(const TruthOrgan &organ, const Points &positions, double line_spacing)
{
  const dataset::SurfaceMesh &rest = organ.surface->rest;
  Points samples = metrics::sample_positions(organ.material_points, rest.triangles, positions);
  const double rotation = metrics::rotation_angle(metrics::best_rotation(organ.rest_samples, samples));
  return {.samples = std::move(samples),
          .normals = metrics::sample_normals(organ.material_points, rest.triangles, positions),
          .surface = metrics::SurfaceTree(positions, rest.triangles, rest.region),
          .inside = metrics::InsideIntervals(positions, rest.triangles, line_spacing),
          .volume = metrics::enclosed_volume(positions, rest.triangles),
          .rotation = rotation};
}

/// Contours and sections in the validation slices.
void cut(TruthOrgan &organ, const Points &positions, const dataset::Anatomy &anatomy)
{
  const dataset::SurfaceMesh &rest = organ.surface->rest;
  double largest = 0;
  for (int k = -anatomy.n_slices_each_side; k <= anatomy.n_slices_each_side; ++k)
  {
    const dataset::Plane plane = metrics::slice_plane(anatomy.dyn_plane, k, anatomy.slice_pitch);
    auto segments = metrics::cut_surface(positions, rest.triangles, rest.region, plane);
    if (segments.empty())
      continue;
    organ.cuts.emplace(k, std::move(segments));
    const double area = metrics::section_area(positions, rest.triangles, plane);
    organ.sections.push_back({organ.surface->name, k, area, 0});
    largest = std::max(largest, area);
  }
  for (TruthSection &section : organ.sections)
    section.share = largest > 0 ? section.area / largest : 0;
}
} // namespace

TruthOrgan prepare_truth(const dataset::TruthSurface &surface, const dataset::Anatomy &anatomy,
                         const EvaluateOptions &options)
{
  TruthOrgan organ;
  organ.surface = &surface;
  organ.material_points = metrics::sample_surface(surface.rest, options.surface_spacing);
  organ.rest_samples = metrics::sample_positions(organ.material_points, surface.rest.triangles, surface.rest.points);
  organ.rest_volume = metrics::enclosed_volume(surface.rest.points, surface.rest.triangles);
  for (const Points &displacement : surface.displacements)
    organ.increments.push_back(prepare_increment(organ, surface.rest.points + displacement, options.line_spacing));
  cut(organ, surface.rest.points + surface.displacements.back(), anatomy);
  if (!organ.cuts.contains(0))
    throw InputError(
        fmt::format("evaluate: the DYN plane misses the truth's {} at the last increment, it must cut every "
                    "organ; check the case's DYN plane",
                    surface.name));
  organ.offsets = metrics::plane_offsets(organ.increments.back().samples, anatomy.dyn_plane);
  return organ;
}

OrganMotion motion_of(const TruthOrgan &organ, const dataset::SurfaceMesh &unmoved, const dataset::Plane &plane)
{
  const Points displacement = organ.increments.back().samples - organ.rest_samples;
  const Eigen::VectorXd length = displacement.rowwise().norm();
  const Eigen::VectorXd off_plane = (displacement * plane.normal).cwiseAbs();
  return {organ.surface->name,
          length.mean(),
          length.maxCoeff(),
          off_plane.mean(),
          off_plane.maxCoeff(),
          metrics::describe(
              metrics::surface_distances(organ.rest_samples, unmoved.points, unmoved.triangles, unmoved.region))};
}

double mean_in_plane_displacement(const dataset::TruthSurface &surface, const dataset::Plane &plane)
{
  double length = 0, sum = 0;
  const auto in_plane = [&](const metrics::EdgeCut &cut)
  {
    const Eigen::Vector3d displacement = cut.interpolate(surface.displacements.back());
    return (displacement - displacement.dot(plane.normal) * plane.normal).norm();
  };
  for (const auto &segment :
       metrics::cut_surface(surface.rest.points, surface.rest.triangles, surface.rest.region, plane))
  {
    length += segment.length();
    sum += segment.length() * 0.5 * (in_plane(segment.ends[0]) + in_plane(segment.ends[1]));
  }
  if (!(length > 0))
    throw InputError(
        fmt::format("evaluate: the DYN plane misses the {} at rest, it must cut every organ; check the case's "
                    "DYN plane",
                    surface.name));
  return sum / length;
}
} // namespace pelvireg::runner
