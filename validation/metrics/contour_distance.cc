#include "validation/metrics/contour_distance.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pelvireg::metrics
{
double contour_length(const std::vector<CutSegment> &segments)
{
  double length = 0;
  for (const CutSegment &segment : segments)
    length += segment.length();
  return length;
}

dataset::Points sample_contour(const std::vector<CutSegment> &segments, double spacing)
{
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw InputError(fmt::format("contour samples: spacing is {} mm, must be a positive number", spacing));
  const double length = contour_length(segments);
  const auto n = static_cast<Eigen::Index>(std::ceil(length / spacing));
  dataset::Points samples(n, 3);
  std::size_t current = 0;
  double passed = 0; // length of the segments before the current one
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double target = (static_cast<double>(i) + 0.5) / static_cast<double>(n) * length;
    while (current + 1 < segments.size() && passed + segments[current].length() < target)
      passed += segments[current++].length();
    const CutSegment &segment = segments[current];
    const double parameter = std::clamp((target - passed) / segment.length(), 0.0, 1.0);
    samples.row(i) = (1 - parameter) * segment.ends[0].position + parameter * segment.ends[1].position;
  }
  return samples;
}

std::vector<double> contour_distances(const std::vector<CutSegment> &truth, const std::vector<CutSegment> &estimate,
                                      double spacing)
{
  if (truth.empty() || estimate.empty())
    throw InputError(fmt::format("contour distance: the plane misses the {}, both contours must exist",
                                 truth.empty() ? "truth" : "estimate"));
  const dataset::Points samples = sample_contour(truth, spacing);
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
  {
    const Eigen::Vector3d sample = samples.row(i);
    double best = std::numeric_limits<double>::infinity();
    for (const CutSegment &segment : estimate)
    {
      const Eigen::Vector3d foot = closest_point_on_segment(sample, segment.ends[0].position, segment.ends[1].position);
      best = std::min(best, (foot - sample).squaredNorm());
    }
    distances.push_back(std::sqrt(best));
  }
  return distances;
}
} // namespace pelvireg::metrics
