// How far a tracked outline is from the truth's in the image plane.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/plane_cut.h"
#include "validation/metrics/surface_samples.h"

#include <vector>

namespace pelvireg::metrics
{
/// The outline of one organ at rest, whose points stand for material points of the truth's surface.
class OutlineTruth
{
public:
  /// @param rest     the truth's surface at rest
  /// @param contours closed polylines (k x 3, mm) on it, in `plane`
  /// Points on caps and on the cervix patch are not scored: an image shows no border there.
  /// Throws InputError when no scored part of the surface lies on the contours.
  OutlineTruth(const dataset::SurfaceMesh &rest, std::vector<dataset::Points> contours, const dataset::Plane &plane);

  /// Of contour `contour`'s points: 1 where they are scored.
  const std::vector<char> &is_scored(std::size_t contour) const { return is_scored_[contour]; }

  struct Error
  {
    int n_points = 0;      ///< material points scored
    double mean = 0;       ///< mm, average symmetric distance of the outlines, a sample every mm of either
    double hd95 = 0;       ///< mm, the larger of the two directed 95th percentiles
    double normal = 0;     ///< mm, mean distance of the tracked material points to the true outline
    double tangential = 0; ///< mm, mean part along the true outline of the way from each material point's true place
                           ///< to its tracked one: drift along the outline. The part out of the plane, which no image
                           ///< shows, is in neither
  };

  /// @param positions the truth's nodes at one instant (n x 3, mm)
  /// @param tracked   the contours' points at that instant, as tracked, in the plane; rows as in the constructor
  /// Throws InputError for another number of rows, a value that is not finite, or when the plane no longer cuts a
  /// scored part of the surface.
  Error error(const dataset::Points &positions, const std::vector<dataset::Points> &tracked) const;

private:
  std::vector<CutSegment> true_outline(const dataset::Points &positions) const;

  const dataset::SurfaceMesh &rest_;
  dataset::Plane plane_;
  std::vector<std::vector<SurfaceSample>> material_points_; ///< of each contour's points
  std::vector<std::vector<char>> is_scored_;
};

/// The truth's nodes `increments` (0 … number of increments, fractions allowed) after rest: linear between increments.
dataset::Points interpolated_positions(const dataset::SurfaceMesh &rest,
                                       const std::vector<dataset::Points> &displacements, double increments);
} // namespace pelvireg::metrics
