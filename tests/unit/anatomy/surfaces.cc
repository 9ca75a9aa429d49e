#include "tests/unit/anatomy/surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <vector>

namespace pelvireg::test
{
using dataset::SurfaceMesh;
using dataset::SurfaceRegion;
using Eigen::Vector3d;

namespace
{
constexpr auto patch = static_cast<std::int32_t>(SurfaceRegion::cervix_patch);

void append(SurfaceMesh &mesh, const SurfaceMesh &other)
{
  const Eigen::Index n = mesh.points.rows(), m = mesh.triangles.rows();
  mesh.points.conservativeResize(n + other.points.rows(), 3);
  mesh.points.bottomRows(other.points.rows()) = other.points;
  mesh.triangles.conservativeResize(m + other.triangles.rows(), 3);
  mesh.triangles.bottomRows(other.triangles.rows()) = (other.triangles.array() + static_cast<int>(n)).matrix();
  mesh.region.conservativeResize(m + other.region.rows());
  mesh.region.tail(other.region.rows()) = other.region;
}

SurfaceMesh quads_to_triangles(const dataset::Points &points, const dataset::Quads9 &cells,
                               const dataset::Integers &region)
{
  static const int pieces[8][3] = {{0, 4, 8}, {0, 8, 7}, {4, 1, 5}, {4, 5, 8},
                                   {7, 8, 6}, {7, 6, 3}, {8, 5, 2}, {8, 2, 6}};
  SurfaceMesh mesh;
  mesh.points = points;
  mesh.triangles.resize(8 * cells.rows(), 3);
  mesh.region.resize(8 * cells.rows());
  for (Eigen::Index c = 0; c < cells.rows(); ++c)
    for (int k = 0; k < 8; ++k)
    {
      mesh.triangles.row(8 * c + k) << cells(c, pieces[k][0]), cells(c, pieces[k][1]), cells(c, pieces[k][2]);
      mesh.region[8 * c + k] = region[c];
    }
  return mesh;
}

struct Triangle
{
  Vector3d p[3];
  Eigen::AlignedBox3d box;
  bool is_patch = false;
  bool near_patch = false;
};

std::vector<Triangle> triangles_of(const SurfaceMesh &mesh)
{
  std::vector<Triangle> result;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    Triangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      triangle.p[k] = mesh.points.row(mesh.triangles(t, k)).transpose();
      triangle.box.extend(triangle.p[k]);
    }
    triangle.is_patch = mesh.region[t] == patch;
    result.push_back(triangle);
  }
  return result;
}

double segment_distance(const Vector3d &p, const Vector3d &q, const Vector3d &r, const Vector3d &s)
{
  const Vector3d d1 = q - p, d2 = s - r, w = p - r;
  const double a = d1.dot(d1), e = d2.dot(d2), f = d2.dot(w), c = d1.dot(w), b = d1.dot(d2),
               denominator = a * e - b * b;
  double u = denominator > 0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0;
  double v = (b * u + f) / e;
  if (v < 0 || v > 1)
  {
    v = std::clamp(v, 0.0, 1.0);
    u = std::clamp((b * v - c) / a, 0.0, 1.0);
  }
  return (w + u * d1 - v * d2).norm();
}

/// Distance of a point above the inside of a triangle; infinite when it projects outside (the edges see to that).
double face_distance(const Vector3d &p, const Triangle &t)
{
  const Vector3d n = (t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]).normalized();
  for (int k = 0; k < 3; ++k)
    if ((t.p[(k + 1) % 3] - t.p[k]).cross(p - t.p[k]).dot(n) < 0)
      return std::numeric_limits<double>::infinity();
  return std::abs((p - t.p[0]).dot(n));
}

bool edge_crosses(const Vector3d &p, const Vector3d &q, const Triangle &t)
{
  const Vector3d n = (t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]);
  const double dp = n.dot(p - t.p[0]), dq = n.dot(q - t.p[0]);
  if (dp * dq > 0 || dp == dq)
    return false;
  return face_distance(p + dp / (dp - dq) * (q - p), t) < std::numeric_limits<double>::infinity();
}

double distance(const Triangle &a, const Triangle &b)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    if (edge_crosses(a.p[i], a.p[(i + 1) % 3], b) || edge_crosses(b.p[i], b.p[(i + 1) % 3], a))
      return 0;
    least = std::min({least, face_distance(a.p[i], b), face_distance(b.p[i], a)});
    for (int j = 0; j < 3; ++j)
      least = std::min(least, segment_distance(a.p[i], a.p[(i + 1) % 3], b.p[j], b.p[(j + 1) % 3]));
  }
  return least;
}

void mark_near_patch(std::vector<Triangle> &triangles, const std::vector<Triangle> &patch_triangles, double margin)
{
  for (Triangle &triangle : triangles)
    for (const Triangle &other : patch_triangles)
      if (triangle.box.exteriorDistance(other.box) <= margin && distance(triangle, other) <= margin)
        triangle.near_patch = true;
}
} // namespace

SurfaceMesh outer_surface(const dataset::ReferenceShell &shell, double side)
{
  const dataset::Points points = shell.midsurface + side * (shell.thickness.asDiagonal() * shell.directors);
  return quads_to_triangles(points, shell.cells, shell.region);
}

SurfaceMesh outer_surface(const dataset::ReferenceSolid &solid)
{
  static const int pieces[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  SurfaceMesh mesh;
  mesh.points = solid.points;
  mesh.triangles.resize(4 * solid.faces.rows(), 3);
  mesh.region.resize(4 * solid.faces.rows());
  for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
    for (int k = 0; k < 4; ++k)
    {
      mesh.triangles.row(4 * f + k) << solid.faces(f, pieces[k][0]), solid.faces(f, pieces[k][1]),
          solid.faces(f, pieces[k][2]);
      mesh.region[4 * f + k] = solid.region[f];
    }
  return mesh;
}

SurfaceMesh floor_surfaces(const dataset::ReferenceShell &floor)
{
  SurfaceMesh mesh = outer_surface(floor, 0.5);
  const auto n = static_cast<std::int32_t>(mesh.points.rows());
  append(mesh, outer_surface(floor, -0.5));
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (Eigen::Index c = 0; c < floor.cells.rows(); ++c)
    for (int k = 0; k < 4; ++k)
      edges[{floor.cells(c, k), floor.cells(c, (k + 1) % 4)}] = floor.cells(c, 4 + k);
  std::vector<Eigen::RowVector3i> sides;
  for (const auto &[edge, middle] : edges)
    if (edges.count({edge.second, edge.first}) == 0)
      for (const auto &[a, b] : {std::pair{edge.first, middle}, std::pair{middle, edge.second}})
      {
        sides.push_back({a, b + n, b});
        sides.push_back({a, a + n, b + n});
      }
  const Eigen::Index m = mesh.triangles.rows();
  mesh.triangles.conservativeResize(m + static_cast<Eigen::Index>(sides.size()), 3);
  mesh.region.conservativeResize(mesh.triangles.rows());
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    mesh.triangles.row(m + static_cast<Eigen::Index>(i)) = sides[i];
    mesh.region[m + static_cast<Eigen::Index>(i)] = 0;
  }
  return mesh;
}

std::map<std::string, SurfaceMesh> reference_surfaces(const dataset::ReferenceModel &model)
{
  std::map<std::string, SurfaceMesh> result;
  for (const dataset::ReferenceShell &shell : model.shells)
    result[shell.name] = shell.name == "pelvic_floor" ? floor_surfaces(shell) : outer_surface(shell);
  for (const dataset::ReferenceSolid &solid : model.solids)
    result[solid.name] = outer_surface(solid);
  return result;
}

std::map<std::string, SurfaceMesh> registration_surfaces(const dataset::RegistrationModel &model)
{
  std::map<std::string, SurfaceMesh> result;
  for (const dataset::RegistrationBody &body : model.bodies)
    if (body.outer_triangles.rows() > 0)
      result[body.name] = {body.points, body.outer_triangles, body.outer_region};
  return result;
}

Gap gap_between(const SurfaceMesh &a, const SurfaceMesh &b, double rim_margin)
{
  std::vector<Triangle> first = triangles_of(a), second = triangles_of(b), patches;
  for (const std::vector<Triangle> *list : {&first, &second})
    std::copy_if(list->begin(), list->end(), std::back_inserter(patches), [](const Triangle &t) { return t.is_patch; });
  mark_near_patch(first, patches, rim_margin);
  mark_near_patch(second, patches, rim_margin);
  Gap gap;
  gap.distance = std::numeric_limits<double>::infinity();
  for (const Triangle &t : first)
    for (const Triangle &u : second)
    {
      if (t.is_patch || u.is_patch || (t.near_patch && u.near_patch) || t.box.exteriorDistance(u.box) >= gap.distance)
        continue;
      const double d = distance(t, u);
      if (d < gap.distance)
        gap = {d, t.p[0]};
    }
  return gap;
}

double distance_to(const Vector3d &point, const SurfaceMesh &surface)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle &t : triangles_of(surface))
  {
    if (t.box.exteriorDistance(point) >= least)
      continue;
    least = std::min(least, face_distance(point, t));
    for (int k = 0; k < 3; ++k)
      least = std::min(least, segment_distance(t.p[k], t.p[(k + 1) % 3], point, point + Vector3d(1e-12, 0, 0)));
  }
  return least;
}

bool segment_meets(const Vector3d &a, const Vector3d &b, const SurfaceMesh &surface)
{
  const std::vector<Triangle> triangles = triangles_of(surface);
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle &t) { return edge_crosses(a, b, t); });
}

double enclosed_volume(const SurfaceMesh &surface)
{
  double volume = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    const Vector3d a = surface.points.row(surface.triangles(t, 0)).transpose();
    const Vector3d b = surface.points.row(surface.triangles(t, 1)).transpose();
    const Vector3d c = surface.points.row(surface.triangles(t, 2)).transpose();
    volume += a.cross(b).dot(c) / 6;
  }
  return volume;
}
} // namespace pelvireg::test
