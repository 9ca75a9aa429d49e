#include "synthetic/observation/images/tissue_bodies.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pelvireg::observation
{
namespace
{
using dataset::Points;
using dataset::SurfaceMesh;
using Eigen::Vector3d;

const std::map<std::string, Tissue> tissues = {{"bladder", Tissue::bladder},
                                               {"vagina", Tissue::vagina},
                                               {"uterus", Tissue::uterus},
                                               {"rectum", Tissue::rectum},
                                               {"pelvic_floor", Tissue::floor}};

const dataset::ReferenceShell &shell_of(const dataset::Anatomy &anatomy, const std::string &name)
{
  for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
    if (shell.name == name)
      return shell;
  throw InputError("The anatomy of case " + anatomy.case_name + " has no shell " + name +
                   ", whose wall the images show; run `pelvireg anatomy` again.");
}

/// Thickness of the shell at its node nearest to each point.
Eigen::VectorXd wall_at(const dataset::ReferenceShell &shell, const Points &points)
{
  const Points outer = shell.midsurface + (0.5 * shell.thickness).asDiagonal() * shell.directors;
  Eigen::VectorXd wall(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    Eigen::Index nearest = 0;
    (outer.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    wall[i] = shell.thickness[nearest];
  }
  return wall;
}

Vector3d triangle_normal(const Points &points, const dataset::Triangles &triangles, Eigen::Index t)
{
  const Vector3d a = points.row(triangles(t, 0)), b = points.row(triangles(t, 1)), c = points.row(triangles(t, 2));
  return (b - a).cross(c - a); // twice the area long
}

/// Area-weighted unit normals at the nodes; caps have no say, so that a rim's normal is its wall's.
Points wall_normals(const Points &points, const SurfaceMesh &mesh)
{
  Points normals = Points::Zero(points.rows(), 3);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    if (mesh.region.size() == 0 || mesh.region[t] != static_cast<std::int32_t>(dataset::SurfaceRegion::cap))
      for (int corner = 0; corner < 3; ++corner)
        normals.row(mesh.triangles(t, corner)) += triangle_normal(points, mesh.triangles, t);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (normals.row(i).norm() > 0)
      normals.row(i).normalize();
  return normals;
}

/// Edges that only one triangle has, as it runs along them.
std::vector<std::pair<std::int32_t, std::int32_t>> border_edges(const dataset::Triangles &triangles)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int i = 0; i < 3; ++i)
      ++directed[{triangles(t, i), triangles(t, (i + 1) % 3)}];
  std::vector<std::pair<std::int32_t, std::int32_t>> border;
  for (const auto &[edge, unused] : directed)
    if (!directed.contains({edge.second, edge.first}))
      border.push_back(edge);
  return border;
}

/// The open surface as the upper side of a plate: node i + n lies below node i. Displacements are those of the upper
/// side for both.
TissueBody plate(const dataset::TruthSurface &surface, const Eigen::VectorXd &thickness)
{
  const SurfaceMesh &upper = surface.rest;
  const Eigen::Index n = upper.points.rows(), m = upper.triangles.rows();
  const auto border = border_edges(upper.triangles);
  TissueBody body{.name = surface.name, .tissue = Tissue::floor, .rest = {}, .wall = {}, .displacements = {}};
  body.rest.points.resize(2 * n, 3);
  body.rest.points << upper.points, upper.points - thickness.asDiagonal() * wall_normals(upper.points, upper);
  body.rest.triangles.resize(2 * m + 2 * static_cast<Eigen::Index>(border.size()), 3);
  const std::int32_t below = static_cast<std::int32_t>(n);
  for (Eigen::Index t = 0; t < m; ++t)
  {
    body.rest.triangles.row(t) = upper.triangles.row(t);
    body.rest.triangles.row(m + t) = upper.triangles.row(t).reverse().array() + below;
  }
  Eigen::Index next = 2 * m;
  for (const auto &[a, b] : border)
  {
    body.rest.triangles.row(next++) << b, a, a + below;
    body.rest.triangles.row(next++) << b, a + below, b + below;
  }
  body.rest.region = dataset::Integers::Zero(body.rest.triangles.rows());
  body.displacements.push_back(Points::Zero(2 * n, 3));
  for (const Points &moved : surface.displacements)
    body.displacements.emplace_back(2 * n, 3) << moved, moved;
  return body;
}

TissueBody body_of(const dataset::Anatomy &anatomy, const dataset::TruthSurface &surface, Tissue tissue)
{
  if (tissue == Tissue::floor)
    return plate(surface, wall_at(shell_of(anatomy, surface.name), surface.rest.points));
  TissueBody body{.name = surface.name, .tissue = tissue, .rest = surface.rest, .wall = {}, .displacements = {}};
  if (tissue != Tissue::uterus)
    body.wall = wall_at(shell_of(anatomy, surface.name), surface.rest.points);
  body.displacements.push_back(Points::Zero(surface.rest.points.rows(), 3));
  body.displacements.insert(body.displacements.end(), surface.displacements.begin(), surface.displacements.end());
  return body;
}
} // namespace

std::vector<TissueBody> tissue_bodies(const dataset::Anatomy &anatomy, const dataset::Truth &truth)
{
  std::vector<TissueBody> bodies;
  for (const dataset::TruthSurface &surface : truth.surfaces)
  {
    const auto tissue = tissues.find(surface.name);
    if (tissue == tissues.end())
      continue;
    if (surface.displacements.size() != truth.increments.size())
      throw InputError("The truth's surface " + surface.name +
                       " has not one displacement field an increment; run "
                       "`pelvireg reference` again.");
    bodies.push_back(body_of(anatomy, surface, tissue->second));
  }
  for (const std::string &organ : dataset::organ_names)
    if (std::none_of(bodies.begin(), bodies.end(), [&](const TissueBody &body) { return body.name == organ; }))
      throw InputError("The truth of case " + truth.case_name + " has no surface " + organ +
                       ", which the images show; run `pelvireg reference` again.");
  return bodies;
}

Points displacements_at(const TissueBody &body, double increment)
{
  const double last = static_cast<double>(body.displacements.size() - 1);
  const double held = std::clamp(increment, 0.0, last);
  const std::size_t before = std::min(static_cast<std::size_t>(held), body.displacements.size() - 1);
  const double share = held - static_cast<double>(before);
  if (share == 0)
    return body.displacements[before];
  return (1 - share) * body.displacements[before] + share * body.displacements[before + 1];
}

SurfaceMesh outer_surface(const TissueBody &body, double increment)
{
  SurfaceMesh surface = body.rest;
  surface.points += displacements_at(body, increment);
  return surface;
}

SurfaceMesh inner_surface(const TissueBody &body, double increment)
{
  SurfaceMesh surface = outer_surface(body, increment);
  const Eigen::ArrayXd rest_areas = node_areas(body.rest.points, body.rest.triangles).array();
  const Eigen::ArrayXd areas = node_areas(surface.points, surface.triangles).array();
  const Eigen::VectorXd wall = body.wall.array() * (rest_areas / areas).max(0.5).min(1.5);
  surface.points -= wall.asDiagonal() * wall_normals(surface.points, body.rest);
  return surface;
}

Eigen::VectorXd node_areas(const Points &points, const dataset::Triangles &triangles)
{
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      areas[triangles(t, corner)] += triangle_normal(points, triangles, t).norm() / 6;
  return areas;
}

MovedPoints moved_points(const TissueBody &body, std::size_t increment)
{
  return {body.rest.points, body.displacements[increment], node_areas(body.rest.points, body.rest.triangles)};
}

MovedPoints moved_points(const std::vector<TissueBody> &bodies, std::size_t increment)
{
  Eigen::Index n = 0;
  for (const TissueBody &body : bodies)
    n += body.rest.points.rows();
  MovedPoints all{Points(n, 3), Points(n, 3), Eigen::VectorXd(n)};
  Eigen::Index next = 0;
  for (const TissueBody &body : bodies)
  {
    const MovedPoints own = moved_points(body, increment);
    all.rest.middleRows(next, own.rest.rows()) = own.rest;
    all.displacements.middleRows(next, own.rest.rows()) = own.displacements;
    all.areas.segment(next, own.rest.rows()) = own.areas;
    next += own.rest.rows();
  }
  return all;
}
} // namespace pelvireg::observation
