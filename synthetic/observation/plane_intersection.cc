#include "synthetic/observation/plane_intersection.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector3d;
using Edge = std::pair<std::int32_t, std::int32_t>; ///< lower vertex first

/// The piece of the intersection inside one triangle, from one of its crossed edges to the other.
struct Piece
{
  Edge end;
  std::int32_t triangle = 0;
};
using Pieces = std::map<Edge, Piece>; ///< by the crossed edge at which the piece starts

Edge edge_of(std::int32_t a, std::int32_t b)
{
  return {std::min(a, b), std::max(a, b)};
}

/// Walking round a triangle counter-clockwise seen from outside, the contour (organ on its left seen from the tip of
/// the plane's normal) enters through the edge that goes from + to - and leaves through the one from - to +.
Pieces cut_triangles(const dataset::SurfaceMesh &surface, const Eigen::VectorXd &distance, const std::string &name)
{
  Pieces pieces;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    Edge start, end;
    bool crossed = false;
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t a = surface.triangles(t, i), b = surface.triangles(t, (i + 1) % 3);
      const bool a_above = distance[a] >= 0, b_above = distance[b] >= 0;
      if (a_above && !b_above)
      {
        start = edge_of(a, b);
        crossed = true;
      }
      else if (!a_above && b_above)
        end = edge_of(a, b);
    }
    if (crossed && !pieces.emplace(start, Piece{end, static_cast<std::int32_t>(t)}).second)
      throw InputError("Surface " + name + " is not manifold at edge " + std::to_string(start.first) + "-" +
                       std::to_string(start.second) +
                       ": two triangles run through it in the same direction; repair the surface's triangles.");
  }
  return pieces;
}

/// Interpolated from the end nearer to the plane, so that an end in the plane is met exactly; both triangles at the
/// edge get the same bits.
Vector3d crossing(const dataset::SurfaceMesh &surface, const Eigen::VectorXd &distance, const Edge &edge)
{
  auto [near, far] = edge;
  if (std::abs(distance[far]) < std::abs(distance[near]))
    std::swap(near, far);
  const Vector3d p = surface.points.row(near), q = surface.points.row(far);
  return p + distance[near] / (distance[near] - distance[far]) * (q - p);
}

/// Outward normal of the triangle projected into the plane; from the direction of the segment where the triangle has
/// no area or lies almost in the plane.
Vector3d in_plane_normal(const dataset::SurfaceMesh &surface, std::int32_t triangle, const Vector3d &plane_normal,
                         const Vector3d &segment)
{
  const Vector3d a = surface.points.row(surface.triangles(triangle, 0));
  const Vector3d b = surface.points.row(surface.triangles(triangle, 1));
  const Vector3d c = surface.points.row(surface.triangles(triangle, 2));
  const Vector3d normal = (b - a).cross(c - a);
  const Vector3d projected = normal - normal.dot(plane_normal) * plane_normal;
  const double least = 1e-6 * normal.norm();
  if (least > 0 && projected.norm() > least)
    return projected.normalized();
  return segment.cross(plane_normal).normalized();
}

/// Points of a loop that are farther apart than merge_distance, with the triangle of the segment that starts there.
struct Polyline
{
  std::vector<Vector3d> points;
  std::vector<std::int32_t> triangles;
};

Polyline without_tiny_segments(const Polyline &loop)
{
  Polyline kept;
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    if (kept.points.empty() || (loop.points[i] - kept.points.back()).norm() > merge_distance)
    {
      kept.points.push_back(loop.points[i]);
      kept.triangles.push_back(loop.triangles[i]);
    }
    else
      kept.triangles.back() = loop.triangles[i]; // the segment that leaves the merged point is the later one
  while (kept.points.size() > 1 && (kept.points.back() - kept.points.front()).norm() <= merge_distance)
  {
    kept.points.pop_back();
    kept.triangles.pop_back();
  }
  return kept;
}

PlaneLoop to_loop(const dataset::SurfaceMesh &surface, const dataset::Plane &plane, const Polyline &polyline)
{
  const Eigen::Index n = static_cast<Eigen::Index>(polyline.points.size());
  PlaneLoop loop;
  loop.contour.points.resize(n, 3);
  loop.contour.segment_normals.resize(n, 3);
  loop.contour.segment_region.resize(n);
  loop.triangle = polyline.triangles;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Vector3d &p = polyline.points[i], &q = polyline.points[(i + 1) % n];
    const std::int32_t triangle = polyline.triangles[i];
    loop.contour.points.row(i) = p;
    loop.contour.segment_normals.row(i) = in_plane_normal(surface, triangle, plane.normal, q - p);
    loop.contour.segment_region[i] = surface.region.size() > 0 ? surface.region[triangle] : 0;
    loop.length += (q - p).norm();
    loop.area += 0.5 * (p - polyline.points[0]).cross(q - polyline.points[0]).dot(plane.normal);
  }
  return loop;
}

[[noreturn]] void throw_open(const std::string &name, const Edge &edge)
{
  throw InputError("Surface " + name + " is not closed at edge " + std::to_string(edge.first) + "-" +
                   std::to_string(edge.second) + ", so that its outline does not close; add the missing triangles.");
}
} // namespace

std::vector<PlaneLoop> intersect(const dataset::SurfaceMesh &surface, const dataset::Plane &plane,
                                 const std::string &name)
{
  const Eigen::VectorXd distance = (surface.points.rowwise() - plane.origin.transpose()) * plane.normal;
  if (!distance.allFinite())
    throw InputError("Surface " + name + " has a coordinate that is not a finite number.");
  const Pieces pieces = cut_triangles(surface, distance, name);

  std::vector<PlaneLoop> loops;
  std::set<Edge> visited;
  for (const auto &[first, unused] : pieces) // ascending edges: each loop starts at its lowest one
  {
    if (visited.contains(first))
      continue;
    Polyline polyline;
    Edge edge = first;
    do
    {
      const auto piece = pieces.find(edge);
      if (piece == pieces.end() || !visited.insert(edge).second)
        throw_open(name, edge);
      polyline.points.push_back(crossing(surface, distance, edge));
      polyline.triangles.push_back(piece->second.triangle);
      edge = piece->second.end;
    } while (edge != first);
    polyline = without_tiny_segments(polyline);
    if (polyline.points.size() < 3)
      continue;
    PlaneLoop loop = to_loop(surface, plane, polyline);
    if (std::abs(loop.area) > merge_distance * loop.length) // else a touched edge, run along there and back
      loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const PlaneLoop &a, const PlaneLoop &b) { return std::abs(a.area) > std::abs(b.area); });
  return loops;
}
} // namespace pelvireg::observation
