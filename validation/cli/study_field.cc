#include "validation/cli/study_field.h"

#include "validation/metrics/material_points.h"
#include "validation/runner/evaluate_checks.h"

namespace pelvireg::cli
{
namespace
{
constexpr double spacing = 5; // mm, of the judge's samples (EvaluateOptions)

bool is_near_a_bar(const Eigen::Vector3d &point, const std::vector<dataset::Truth> &truths, double distance)
{
  for (const dataset::Truth &truth : truths)
    for (const dataset::TruthTruss &bar : truth.trusses)
      for (Eigen::Index end = 0; end < 2; ++end)
        if ((bar.rest.row(end).transpose() - point).norm() <= distance)
          return true;
  return false;
}
} // namespace

StudyPoints study_points(const std::vector<dataset::Truth> &truths, double bar_distance)
{
  StudyPoints points;
  for (const std::string &organ : dataset::organ_names)
  {
    const dataset::SurfaceMesh &rest = runner::truth_surface(truths.front(), organ).rest;
    points.rest.push_back(
        metrics::sample_positions(metrics::sample_surface(rest, spacing), rest.triangles, rest.points));
    std::vector<bool> near;
    for (Eigen::Index i = 0; i < points.rest.back().rows(); ++i)
      near.push_back(is_near_a_bar(points.rest.back().row(i), truths, bar_distance));
    points.near_bar.push_back(near);
  }
  return points;
}

StudyField::StudyField(const dataset::Truth &truth, const StudyPoints &points)
{
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
  {
    const dataset::TruthSurface &surface = runner::truth_surface(truth, dataset::organ_names[organ]);
    organs_.push_back({&surface, metrics::closest_samples(surface.rest, points.rest[organ])});
  }
}

dataset::Points StudyField::displacements(std::size_t organ, std::size_t increment) const
{
  const dataset::TruthSurface &surface = *organs_[organ].surface;
  return metrics::sample_positions(organs_[organ].places, surface.rest.triangles, surface.displacements.at(increment));
}
} // namespace pelvireg::cli
