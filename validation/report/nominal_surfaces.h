// The outer surfaces that the page shows: of the truth, and of the nominal run of every condition.
#pragma once

#include "validation/report/report.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// One organ's outer surface through time.
struct MovingSurface
{
  dataset::SurfaceMesh rest;
  std::vector<dataset::Points> frames; ///< n x 3 each, mm: at rest, then at each increment or step

  const dataset::Points &at(std::size_t frame) const { return frames[std::min(frame, frames.size() - 1)]; }
  dataset::SurfaceMesh mesh_at(std::size_t frame) const { return {at(frame), rest.triangles, rest.region}; }
};

/// The organs of one condition, dataset::organ_names in order.
struct ConditionSurfaces
{
  std::string condition;   ///< as tables call it
  std::string constraints; ///< the condition of the registration that made it; empty: none did
  std::vector<MovingSurface> organs;
};

/// Frames: rest, then one an increment.
std::vector<MovingSurface> truth_surfaces(const dataset::Truth &truth);

/// Conditions in the evaluation's order. Frames: rest, then one a step; of `unregistered` the rest alone. Left out
/// are a condition without a nominal run and, of several perturbations of one condition, all but the first by name:
/// their nominal runs are the same.
std::vector<ConditionSurfaces> nominal_surfaces(const ReportInputs &inputs);
} // namespace pelvireg::report
