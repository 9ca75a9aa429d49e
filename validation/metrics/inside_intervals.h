// The inside of a closed surface along a fixed family of parallel lines: volumes in common, Dice.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <cstdint>
#include <vector>

namespace pelvireg::metrics
{
/// Where the lines of a square grid run inside a closed surface. The grid is fixed in space, the same for every
/// surface, and turned so that no face of an anatomical body lies along it. Exact along each line; across, a midpoint
/// rule with one line per spacing^2 of area. Inside is where the surface winds around a point at least once: parts of a
/// surface that runs through itself count once, parts turned inside out do not count. Crossings are decided by
/// half-open comparisons of coordinates, so edges and nodes that a line meets count once, without any tolerance.
/// Observed accuracy, 1 mm apart: `docs/verification.md`.
class InsideIntervals
{
public:
  /// points: n x 3, mm; triangles: m x 3, 0-based, closed, normals outward. Throws InputError for a spacing that is not
  /// positive, a position that is not finite or farther than 2000 spacings from the origin, and a surface that a line
  /// enters without leaving.
  InsideIntervals(const dataset::Points &points, const dataset::Triangles &triangles, double spacing);

  double spacing() const { return spacing_; } ///< mm
  double volume() const;                      ///< mm^3

  /// Volume that lies inside both, mm^3. Throws InputError for another spacing.
  double common_volume(const InsideIntervals &other) const;

private:
  struct Interval
  {
    std::int64_t line;
    double begin, end; ///< mm along the line
  };
  std::vector<Interval> intervals_; ///< sorted by line, then begin; those of a line are apart
  double spacing_;
};

/// Dice similarity, 2 |A and B| / (|A| + |B|), by lines `spacing` mm apart: 1 for a surface and itself, 0 for two that
/// are apart. Throws InputError when nothing is inside either.
double dice(const InsideIntervals &a, const InsideIntervals &b);
} // namespace pelvireg::metrics
