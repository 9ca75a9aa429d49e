#include "synthetic/dataset/store.h"

#include <cmath>

namespace pelvireg::dataset
{
namespace
{
constexpr int n_regions = 4; // SurfaceRegion
}

void write_surface(GroupWriter &group, const SurfaceMesh &surface)
{
  group.array("points", surface.points);
  group.array("triangles", surface.triangles);
  group.array("region", surface.region);
}

SurfaceMesh read_surface(const GroupReader &group)
{
  SurfaceMesh surface;
  surface.points = group.array<Points>("points");
  surface.triangles = group.indices<Triangles>("triangles", surface.points.rows());
  surface.region = group.indices<Integers>("region", n_regions);
  if (surface.region.rows() != surface.triangles.rows())
    group.refuse("region", "has not one entry a triangle");
  return surface;
}

void write_plane(GroupWriter &group, const std::string &name, const Plane &plane)
{
  GroupWriter plane_group = group.group(name);
  plane_group.array("origin", plane.origin);
  plane_group.array("normal", plane.normal);
}

Plane read_plane(const GroupReader &group, const std::string &name)
{
  const GroupReader plane_group = group.group(name);
  Plane plane;
  plane.origin = plane_group.array<Eigen::VectorXd>("origin", 3);
  plane.normal = plane_group.array<Eigen::VectorXd>("normal", 3);
  if (!(std::abs(plane.normal.norm() - 1) <= 1e-9))
    plane_group.refuse("normal", "has not length 1");
  return plane;
}
} // namespace pelvireg::dataset
