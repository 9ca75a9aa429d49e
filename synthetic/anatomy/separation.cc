// Every organ is meshed finely; each node of one is measured against the triangles of the other, inside counting as
// negative. Node against triangle misses edge against edge, by less than the meshes' chord error at this size.
#include "synthetic/anatomy/separation.h"

#include "synthetic/anatomy/nearest_point.h"
#include "synthetic/anatomy/organs.h"
#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelvireg::anatomy
{
using dataset::SurfaceRegion;
using Eigen::Vector3d;

namespace
{
constexpr double mesh_size = 4;  // mm
constexpr double rim_margin = 3; // mm around the shared patch, where uterus and vagina part from each other

struct OrganSurface
{
  std::string name;
  TriangleMesh mesh;
  Eigen::AlignedBox3d box;
  std::vector<Vector3d> centres, normals; ///< of the triangles
  std::vector<double> radii;
};

Vector3d corner(const OrganSurface &organ, Eigen::Index triangle, int k)
{
  return organ.mesh.points.row(organ.mesh.triangles(triangle, k)).transpose();
}

OrganSurface organ_surface(const std::string &name, const TriangleMesh &mesh)
{
  OrganSurface organ = {name, mesh, {}, {}, {}, {}};
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
    organ.box.extend(mesh.points.row(i).transpose());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const Vector3d a = corner(organ, t, 0), b = corner(organ, t, 1), c = corner(organ, t, 2), centre = (a + b + c) / 3;
    organ.centres.push_back(centre);
    organ.normals.push_back((b - a).cross(c - a).normalized());
    organ.radii.push_back(std::max({(a - centre).norm(), (b - centre).norm(), (c - centre).norm()}));
  }
  return organ;
}

/// The floor's two faces as one outward surface; its rims stay open.
TriangleMesh floor_faces(const FloorShape &shape)
{
  const TriangleMesh middle = triangle_mesh(floor_charts(shape, mesh_size));
  const Eigen::Index n = middle.points.rows(), m = middle.triangles.rows();
  TriangleMesh faces;
  faces.points.resize(2 * n, 3);
  faces.points << middle.points + shape.thickness / 2 * middle.normals,
      middle.points - shape.thickness / 2 * middle.normals;
  faces.triangles.resize(2 * m, 3);
  faces.triangles.topRows(m) = middle.triangles;
  faces.triangles.bottomRows(m) = (middle.triangles.rowwise().reverse().array() + static_cast<int>(n)).matrix();
  faces.region = dataset::Integers::Zero(2 * m);
  return faces;
}

/// Signed distance of a point to a surface, negative inside. Where several triangles share the nearest point (an edge),
/// the one that faces the point most squarely knows the side.
double signed_distance(const Vector3d &p, const OrganSurface &organ)
{
  constexpr double tie = 1e-9; // mm
  double least = std::numeric_limits<double>::infinity(), height = 0;
  for (std::size_t t = 0; t < organ.centres.size(); ++t)
  {
    if ((p - organ.centres[t]).norm() - organ.radii[t] > least + tie)
      continue;
    const auto row = static_cast<Eigen::Index>(t);
    const Vector3d nearest =
        nearest_on_triangle(p, corner(organ, row, 0), corner(organ, row, 1), corner(organ, row, 2));
    const double distance = (p - nearest).norm(), above = (p - nearest).dot(organ.normals[t]);
    if (distance < least - tie || (distance < least + tie && std::abs(above) > std::abs(height)))
    {
      least = distance;
      height = above;
    }
  }
  return height < 0 ? -least : least;
}

/// Is the point of the uterus or the vagina on the shared patch or so near its rim that the gap must be small?
bool is_at_patch(const Vector3d &p, const CervixPatch &patch)
{
  const Vector3d d = p - patch.centre;
  return std::abs(d.dot(patch.normal)) < rim_margin &&
         (d - d.dot(patch.axis) * patch.axis).norm() < patch.radius + rim_margin;
}

void check_pair(const OrganSurface &a, const OrganSurface &b, const CervixPatch &patch)
{
  const bool share_patch = (a.name == "uterus" && b.name == "vagina") || (a.name == "vagina" && b.name == "uterus");
  for (Eigen::Index i = 0; i < a.mesh.points.rows(); ++i)
  {
    const Vector3d p = a.mesh.points.row(i).transpose();
    if (b.box.exteriorDistance(p) > least_gap || (share_patch && is_at_patch(p, patch)))
      continue;
    const double gap = signed_distance(p, b);
    if (!(gap >= least_gap))
      throw InputError(
          fmt::format("{} and {} {} at ({:.1f}, {:.1f}, {:.1f}) mm: the gap is {:.2f} mm, but at least {} mm is "
                      "needed; move them apart or make one thinner.",
                      a.name, b.name, gap < 0 ? "overlap" : "come too close", p[0], p[1], p[2], gap, least_gap));
  }
}

void check_patch(const Parameters &p)
{
  const CervixPatch patch = cervix_patch(p.uterus, p.vagina);
  const Axis axis("vagina", p.vagina.axis, p.vagina.fillet_radii);
  const double half_length = patch.radius / patch.axis.dot(patch.normal), end = p.vagina.half_depth;
  const double straight = axis.length() - axis.last_straight_start();
  if (!(p.uterus.patch_distance - half_length >= end && p.uterus.patch_distance + half_length <= straight))
    throw InputError(
        fmt::format("uterus.patch_distance is {} mm, but the patch of the cervix ({:.1f} mm either way) must lie "
                    "on the straight part of the vagina, {} to {:.1f} mm from its apex; move or shrink it.",
                    p.uterus.patch_distance, half_length, end, straight));
  if (!(patch.radius <= p.vagina.widths.back() / 2 - p.vagina.half_depth))
    throw InputError(
        fmt::format("uterus.half_widths[0] is {} mm, but the flat of the vagina's wall allows at most {} mm; "
                    "narrow the cervix or widen the vagina.",
                    patch.radius, p.vagina.widths.back() / 2 - p.vagina.half_depth));
}
} // namespace

void check_separation(const Parameters &p)
{
  check_patch(p);
  const std::vector<OrganSurface> organs = {
      organ_surface("bladder", triangle_mesh(bladder_charts(p.bladder, mesh_size))),
      organ_surface("vagina", triangle_mesh(vagina_charts(p.vagina, p.uterus, mesh_size))),
      organ_surface("uterus", triangle_mesh(uterus_charts(p.uterus, p.vagina, mesh_size))),
      organ_surface("rectum", triangle_mesh(rectum_charts(p.rectum, mesh_size))),
      organ_surface("pelvic_floor", floor_faces(p.pelvic_floor))};
  const CervixPatch patch = cervix_patch(p.uterus, p.vagina);
  for (const OrganSurface &a : organs)
    for (const OrganSurface &b : organs)
      // A point beside the floor's open rim has no inside: the organs' nodes are not measured against it, only its own
      // nodes against the organs.
      if (a.name != b.name && b.name != "pelvic_floor")
        check_pair(a, b, patch);
}
} // namespace pelvireg::anatomy
