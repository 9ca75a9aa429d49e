#include "validation/report/worst_places.h"

#include "validation/metrics/surface_distance.h"
#include "validation/metrics/surface_samples.h"

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
namespace
{
constexpr std::size_t n_places = 5;
constexpr double least_distance = 10; ///< mm between two of them

std::vector<WorstPlace> worst_first(std::vector<WorstPlace> places)
{
  std::stable_sort(places.begin(), places.end(),
                   [](const WorstPlace &a, const WorstPlace &b) { return a.error > b.error; });
  std::vector<WorstPlace> kept;
  for (const WorstPlace &place : places)
    if (kept.size() < n_places && std::none_of(kept.begin(), kept.end(),
                                               [&](const WorstPlace &other)
                                               { return (other.position - place.position).norm() < least_distance; }))
      kept.push_back(place);
  return kept;
}
} // namespace

std::vector<WorstPlace> worst_places(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                                     const std::vector<ConditionSurfaces> &conditions)
{
  const dataset::Plane &plane = inputs.anatomy.dyn_plane;
  std::vector<dataset::Points> samples;
  for (const MovingSurface &organ : truth)
    samples.push_back(
        metrics::sample_positions(metrics::sample_surface(organ.rest, inputs.evaluation.options.surface_spacing),
                                  organ.rest.triangles, organ.frames.back()));
  std::vector<WorstPlace> worst;
  for (const ConditionSurfaces &condition : conditions)
  {
    std::vector<WorstPlace> places;
    for (std::size_t organ = 0; organ < truth.size(); ++organ)
    {
      const dataset::SurfaceMesh estimate = condition.organs[organ].mesh_at(condition.organs[organ].frames.size());
      const std::vector<double> errors =
          metrics::surface_distances(samples[organ], estimate.points, estimate.triangles, estimate.region);
      for (std::size_t i = 0; i < errors.size(); ++i)
      {
        const Eigen::Vector3d position = samples[organ].row(static_cast<Eigen::Index>(i));
        places.push_back({condition.condition, dataset::organ_names[organ], errors[i], position,
                          plane.normal.dot(position - plane.origin)});
      }
    }
    const std::vector<WorstPlace> kept = worst_first(std::move(places));
    worst.insert(worst.end(), kept.begin(), kept.end());
  }
  return worst;
}
} // namespace pelvireg::report
