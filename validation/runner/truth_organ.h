// The truth's share in every comparison of one organ, made once.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"
#include "validation/metrics/inside_intervals.h"
#include "validation/metrics/plane_cut.h"
#include "validation/metrics/surface_distance.h"
#include "validation/metrics/surface_samples.h"
#include "validation/runner/evaluation.h"

#include <map>
#include <vector>

namespace pelvireg::runner
{
/// One organ of the truth at one increment; mm.
struct TruthIncrement
{
  dataset::Points samples; ///< k x 3, of the material points
  dataset::Points normals; ///< k x 3, unit, outward, there
  metrics::SurfaceTree surface;
  metrics::InsideIntervals inside;
  double volume = 0;   ///< mm^3
  double rotation = 0; ///< rad, that best carries the material points from rest
};

struct TruthOrgan
{
  const dataset::TruthSurface *surface = nullptr;
  std::vector<metrics::SurfaceSample> material_points;
  dataset::Points rest_samples; ///< k x 3, mm
  double rest_volume = 0;       ///< mm^3
  std::vector<TruthIncrement> increments;
  /// At the last increment by slice index; missed slices are absent.
  std::map<int, std::vector<metrics::CutSegment>> cuts;
  std::vector<TruthSection> sections; ///< the same slices
  std::vector<double> offsets;        ///< mm from the DYN plane, of the samples at the last increment
};

/// Throws InputError when the surface is open or the DYN plane misses it at the last increment.
TruthOrgan prepare_truth(const dataset::TruthSurface &surface, const dataset::Anatomy &anatomy,
                         const EvaluateOptions &options);

/// How the truth moved the organ, and how far the registration's rest mesh `unmoved` is from it before it does.
OrganMotion motion_of(const TruthOrgan &organ, const dataset::SurfaceMesh &unmoved, const dataset::Plane &plane);

/// Rest-arc-length mean of the in-plane displacement of the outer contour in the DYN plane at the last increment
/// (DESIGN 4), mm. Throws InputError when the plane misses the organ at rest.
double mean_in_plane_displacement(const dataset::TruthSurface &surface, const dataset::Plane &plane);
} // namespace pelvireg::runner
