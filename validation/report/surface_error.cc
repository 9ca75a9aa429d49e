#include "validation/report/surface_error.h"

#include "validation/metrics/surface_distance.h"

namespace pelvireg::report
{
dataset::Points displacement_of(const dataset::TruthSurface &surface, std::size_t increment)
{
  return increment == 0 ? dataset::Points::Zero(surface.rest.points.rows(), 3)
                        : surface.displacements.at(increment - 1);
}

std::vector<double> distances_to_truth(const dataset::Truth &truth, const std::string &organ, std::size_t increment,
                                       const dataset::Points &points)
{
  for (const dataset::TruthSurface &surface : truth.surfaces)
    if (surface.name == organ && increment <= surface.displacements.size())
      return metrics::surface_distances(points, surface.rest.points + displacement_of(surface, increment),
                                        surface.rest.triangles, surface.rest.region);
  return {};
}
} // namespace pelvireg::report
