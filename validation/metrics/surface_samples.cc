#include "validation/metrics/surface_samples.h"

#include "synthetic/dataset/error.h"
#include "validation/metrics/surface_distance.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

namespace pelvireg::metrics
{
namespace
{
constexpr int candidates_per_sample = 8;

/// Running sum of the area of the scored triangles, mm^2; a cap adds nothing.
std::vector<double> cumulative_area(const dataset::SurfaceMesh &mesh)
{
  std::vector<double> sums;
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const Eigen::Vector3d a = mesh.points.row(mesh.triangles(t, 0));
    const Eigen::Vector3d b = mesh.points.row(mesh.triangles(t, 1));
    const Eigen::Vector3d c = mesh.points.row(mesh.triangles(t, 2));
    if (is_scored(mesh.region[t]))
      sum += 0.5 * (b - a).cross(c - a).norm();
    sums.push_back(sum);
  }
  return sums;
}

/// Point j of the R2 sequence (Roberts 2018) in the unit square, folded into barycentric weights. Low discrepancy:
/// the candidates of one large triangle do not fall on a line.
Eigen::Vector3d spread_barycentric(int j)
{
  const double plastic_number = 1.32471795724474602596;
  double u = std::fmod(0.5 + j / plastic_number, 1.0);
  double v = std::fmod(0.5 + j / (plastic_number * plastic_number), 1.0);
  if (u + v > 1)
  {
    u = 1 - u;
    v = 1 - v;
  }
  return {1 - u - v, u, v};
}

/// n candidates, each standing for the same area.
std::vector<SurfaceSample> spread_candidates(const std::vector<double> &area, int n)
{
  std::vector<SurfaceSample> candidates;
  std::size_t triangle = 0;
  for (int j = 0; j < n; ++j)
  {
    const double target = (j + 0.5) / n * area.back();
    while (area[triangle] < target)
      ++triangle;
    candidates.push_back({static_cast<int>(triangle), spread_barycentric(j)});
  }
  return candidates;
}

struct Neighbour
{
  int index;
  double weight;
};

/// For each candidate those nearer than `reach`, with a weight that falls from 1 to 0 over it.
std::vector<std::vector<Neighbour>> crowding(const dataset::Points &positions, double reach)
{
  std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    for (Eigen::Index j = i + 1; j < positions.rows(); ++j)
    {
      const double squared_distance = (positions.row(i) - positions.row(j)).squaredNorm();
      if (squared_distance >= reach * reach)
        continue;
      const double weight = std::pow(1 - std::sqrt(squared_distance) / reach, 8);
      neighbours[static_cast<std::size_t>(i)].push_back({static_cast<int>(j), weight});
      neighbours[static_cast<std::size_t>(j)].push_back({static_cast<int>(i), weight});
    }
  return neighbours;
}

/// Remove the most crowded candidate until n are left; ties go to the larger index. Result: is candidate i kept?
std::vector<char> eliminate(const std::vector<std::vector<Neighbour>> &neighbours, int n)
{
  std::vector<double> weight(neighbours.size(), 0.0);
  std::priority_queue<std::pair<double, int>> most_crowded;
  for (std::size_t i = 0; i < neighbours.size(); ++i)
  {
    for (const Neighbour &neighbour : neighbours[i])
      weight[i] += neighbour.weight;
    most_crowded.emplace(weight[i], static_cast<int>(i));
  }
  std::vector<char> kept(neighbours.size(), 1);
  for (int left = static_cast<int>(neighbours.size()); left > n;)
  {
    const auto [known_weight, index] = most_crowded.top();
    const auto i = static_cast<std::size_t>(index);
    most_crowded.pop();
    if (!kept[i] || known_weight != weight[i])
      continue; // an entry from before a neighbour was removed
    kept[i] = 0;
    --left;
    for (const Neighbour &neighbour : neighbours[i])
    {
      const auto k = static_cast<std::size_t>(neighbour.index);
      weight[k] -= neighbour.weight;
      if (kept[k])
        most_crowded.emplace(weight[k], neighbour.index);
    }
  }
  return kept;
}
} // namespace

std::vector<SurfaceSample> sample_surface(const dataset::SurfaceMesh &rest, double spacing)
{
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw InputError(fmt::format("surface samples: spacing is {} mm, must be a positive number", spacing));
  require_usable_surface(rest.points, rest.triangles, rest.region);
  const std::vector<double> area = cumulative_area(rest);
  if (!(area.back() > 0))
    throw InputError("surface samples: the surface without its caps has no area; check triangles and regions");

  const int n = std::max(1, static_cast<int>(std::lround(area.back() / (spacing * spacing))));
  const std::vector<SurfaceSample> candidates = spread_candidates(area, candidates_per_sample * n);
  const dataset::Points positions = sample_positions(candidates, rest.triangles, rest.points);
  // Twice the radius of n discs in their densest packing over the area (Yuksel 2015, equation 1) times two.
  const double reach = 2 * std::sqrt(area.back() / (2 * std::sqrt(3.0) * n));
  const std::vector<char> kept = eliminate(crowding(positions, reach), n);

  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (kept[i])
      samples.push_back(candidates[i]);
  return samples;
}

dataset::Points sample_positions(const std::vector<SurfaceSample> &samples, const dataset::Triangles &triangles,
                                 const dataset::Points &points)
{
  dataset::Points positions(static_cast<Eigen::Index>(samples.size()), 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
  {
    const SurfaceSample &sample = samples[static_cast<std::size_t>(i)];
    const auto nodes = triangles.row(sample.triangle);
    positions.row(i) = sample.barycentric[0] * points.row(nodes[0]) + sample.barycentric[1] * points.row(nodes[1]) +
                       sample.barycentric[2] * points.row(nodes[2]);
  }
  if (!positions.allFinite())
    throw InputError(
        "surface samples: a position is not finite; the truth's displacements are broken, compute them again");
  return positions;
}
} // namespace pelvireg::metrics
