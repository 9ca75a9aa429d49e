// Displacements of two references at the same material points.
#pragma once

#include "synthetic/dataset/truth.h"
#include "validation/metrics/surface_samples.h"

#include <vector>

namespace pelvireg::cli
{
/// Material points of the organs' outer surfaces (one per 25 mm^2, the judge's), organ after organ.
struct StudyPoints
{
  std::vector<dataset::Points> rest;       ///< one an organ (organ_names), k x 3, mm
  std::vector<std::vector<bool>> near_bar; ///< whether a bar ends nearby, in any of the truths
};

/// Points of the first truth's surfaces. `bar_distance` in mm.
StudyPoints study_points(const std::vector<dataset::Truth> &truths, double bar_distance);

/// Displacements (k x 3, mm) of one organ's points at an increment (0-based), in a truth of the same case whatever its
/// mesh.
class StudyField
{
public:
  StudyField(const dataset::Truth &truth, const StudyPoints &points);
  dataset::Points displacements(std::size_t organ, std::size_t increment) const;

private:
  struct Organ
  {
    const dataset::TruthSurface *surface;
    std::vector<metrics::SurfaceSample> places;
  };
  std::vector<Organ> organs_;
};
} // namespace pelvireg::cli
