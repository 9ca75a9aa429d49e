#include "reference_fe/outer_surface.h"

#include "reference_fe/contact/closest_point.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
struct RegionTriangle
{
  std::array<int, 3> nodes;
  std::int32_t region;
};

/// Triangulates a convex loop in strips across it, so that no triangle spans the whole loop from one node.
void append_cap(const std::vector<int> &loop, std::vector<RegionTriangle> &triangles)
{
  const auto cap = static_cast<std::int32_t>(dataset::SurfaceRegion::cap);
  int front = 0, back = static_cast<int>(loop.size()) - 1;
  for (bool advance_front = true; back - front >= 2; advance_front = !advance_front)
  {
    const int third = advance_front ? front + 1 : back - 1;
    // The cap runs against the faces.
    triangles.push_back({{loop[back], loop[third], loop[front]}, cap});
    (advance_front ? front : back) = third;
  }
}

void fill(const std::vector<RegionTriangle> &triangles, const std::map<int, int> *renumbered, OuterSurface &surface)
{
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  surface.region.resize(static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
      surface.triangles(static_cast<Eigen::Index>(t), k) =
          renumbered ? renumbered->at(triangles[t].nodes[k]) : triangles[t].nodes[k];
    surface.region[static_cast<Eigen::Index>(t)] = triangles[t].region;
  }
}

template <class Nodes> Eigen::VectorXd shares_at(const Eigen::VectorXd &share, const Nodes &nodes, std::int32_t region)
{
  if (share.size() == 0)
    return Eigen::VectorXd::Constant(nodes.size(),
                                     region == static_cast<std::int32_t>(dataset::SurfaceRegion::peritoneal));
  return share(nodes.transpose());
}
} // namespace

SurfaceNode shell_node(const dataset::ReferenceShell &shell, int first_unknown, int node, int side)
{
  return {first_unknown + 7 * node, side, shell.midsurface.row(node).transpose(), shell.directors.row(node).transpose(),
          0.5 * shell.thickness[node]};
}

SurfaceNode solid_node(const dataset::ReferenceSolid &solid, int first_unknown, int node)
{
  return {first_unknown + 3 * node, 0, solid.points.row(node).transpose(), Eigen::Vector3d::Zero(), 0};
}

SurfaceFace shell_face(const dataset::ReferenceShell &shell, int first_unknown, Eigen::Index cell, int side)
{
  SurfaceFace face;
  for (int i = 0; i < 9; ++i)
    face.nodes.push_back(shell_node(shell, first_unknown, shell.cells(cell, i), side));
  return face;
}

SurfaceFace solid_face(const dataset::ReferenceSolid &solid, int first_unknown, Eigen::Index face_index)
{
  SurfaceFace face;
  for (int i = 0; i < 6; ++i)
    face.nodes.push_back(solid_node(solid, first_unknown, solid.faces(face_index, i)));
  return face;
}

Eigen::VectorXd pressure_shares(const dataset::ReferenceShell &shell, Eigen::Index cell)
{
  return shares_at(shell.pressure_share, shell.cells.row(cell), shell.region[cell]);
}

Eigen::VectorXd pressure_shares(const dataset::ReferenceSolid &solid, Eigen::Index face)
{
  return shares_at(solid.pressure_share, solid.faces.row(face), solid.region[face]);
}

std::vector<int> oriented_rim(const dataset::ReferenceShell &shell, const dataset::Integers &rim)
{
  std::set<std::pair<int, int>> half_edges; // corner to mid-side, and mid-side to corner, as the cells run
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int k = 0; k < 4; ++k)
    {
      half_edges.insert({shell.cells(c, k), shell.cells(c, 4 + k)});
      half_edges.insert({shell.cells(c, 4 + k), shell.cells(c, (k + 1) % 4)});
    }
  std::set<int> corners;
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    corners.insert(shell.cells.row(c).data(), shell.cells.row(c).data() + 4);

  std::vector<int> loop(rim.data(), rim.data() + rim.size());
  if (loop.size() >= 2 && !half_edges.count({loop[0], loop[1]}))
    std::reverse(loop.begin(), loop.end());
  if (!loop.empty() && !corners.count(loop[0]))
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (loop.size() % 2 != 0 || !half_edges.count({loop[i], loop[(i + 1) % loop.size()]}))
      throw InputError(
          fmt::format("shell '{}': rim node {} (position {} of {}) is not followed along a cell edge; list a "
                      "rim as a closed loop of alternating corner and mid-side nodes",
                      shell.name, loop[i], i, loop.size()));
  return loop;
}

OuterSurface outer_surface(const dataset::ReferenceShell &shell, int first_unknown)
{
  OuterSurface surface;
  surface.part = shell.name;
  for (int n = 0; n < static_cast<int>(shell.midsurface.rows()); ++n)
    surface.vertices.push_back(shell_node(shell, first_unknown, n, +1));
  std::vector<RegionTriangle> triangles;
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (const std::array<int, 3> &facet : face_facets(9))
      triangles.push_back(
          {{shell.cells(c, facet[0]), shell.cells(c, facet[1]), shell.cells(c, facet[2])}, shell.region[c]});
  for (const dataset::Integers &rim : shell.rims)
    append_cap(oriented_rim(shell, rim), triangles);
  fill(triangles, nullptr, surface);
  return surface;
}

OuterSurface outer_surface(const dataset::ReferenceSolid &solid, int first_unknown)
{
  OuterSurface surface;
  surface.part = solid.name;
  std::map<int, int> renumbered;
  for (Eigen::Index i = 0; i < solid.faces.size(); ++i)
    renumbered[solid.faces.data()[i]] = 0;
  for (auto &[node, number] : renumbered)
  {
    number = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(solid_node(solid, first_unknown, node));
  }
  std::vector<RegionTriangle> triangles;
  for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
    for (const std::array<int, 3> &facet : face_facets(6))
      triangles.push_back(
          {{solid.faces(f, facet[0]), solid.faces(f, facet[1]), solid.faces(f, facet[2])}, solid.region[f]});
  fill(triangles, &renumbered, surface);
  return surface;
}

int table_rank(const std::string &part)
{
  std::vector<std::string> order = dataset::organ_names;
  order.push_back("pelvic_floor");
  return static_cast<int>(std::find(order.begin(), order.end(), part) - order.begin());
}
} // namespace pelvireg::reference_fe
