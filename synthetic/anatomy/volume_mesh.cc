#include "synthetic/anatomy/volume_mesh.h"

#include "synthetic/dataset/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace pelvireg::anatomy
{
namespace
{
/// gmsh is one global state: started fresh for every mesh, so that no option or model leaks into the next one.
class GmshSession
{
public:
  GmshSession()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.RandomSeed", 1);
    gmsh::option::setNumber("Mesh.Algorithm3D", 1); // Delaunay
    gmsh::option::setNumber("Mesh.Optimize", 1);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession &) = delete;
  GmshSession &operator=(const GmshSession &) = delete;
};

void add_surface(const TriangleMesh &surface)
{
  std::vector<std::size_t> node_tags, triangle_tags, connectivity;
  std::vector<double> coordinates;
  for (Eigen::Index i = 0; i < surface.points.rows(); ++i)
  {
    node_tags.push_back(static_cast<std::size_t>(i) + 1);
    for (int k = 0; k < 3; ++k)
      coordinates.push_back(surface.points(i, k));
  }
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    triangle_tags.push_back(static_cast<std::size_t>(t) + 1);
    for (int k = 0; k < 3; ++k)
      connectivity.push_back(static_cast<std::size_t>(surface.triangles(t, k)) + 1);
  }
  gmsh::model::addDiscreteEntity(2, 1);
  gmsh::model::mesh::addNodes(2, 1, node_tags, coordinates);
  gmsh::model::mesh::addElementsByType(1, 2, triangle_tags, connectivity);
}

VolumeMesh read_back(const TriangleMesh &surface)
{
  std::vector<std::size_t> node_tags, tet_tags, tet_nodes;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(node_tags, coordinates, parametric, 3, -1, false, false);
  gmsh::model::mesh::getElementsByType(4, tet_tags, tet_nodes);
  const Eigen::Index n_surface = surface.points.rows();
  VolumeMesh mesh;
  mesh.points.resize(n_surface + static_cast<Eigen::Index>(node_tags.size()), 3);
  mesh.points.topRows(n_surface) = surface.points;
  std::map<std::size_t, std::int32_t> index_of;
  for (std::size_t i = 0; i < node_tags.size(); ++i)
  {
    const Eigen::Index row = n_surface + static_cast<Eigen::Index>(i);
    mesh.points.row(row) << coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2];
    index_of[node_tags[i]] = static_cast<std::int32_t>(row);
  }
  mesh.tets.resize(static_cast<Eigen::Index>(tet_tags.size()), 4);
  for (std::size_t i = 0; i < tet_nodes.size(); ++i)
  {
    const std::size_t tag = tet_nodes[i];
    mesh.tets(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
        tag <= static_cast<std::size_t>(n_surface) ? static_cast<std::int32_t>(tag - 1) : index_of.at(tag);
  }
  return mesh;
}

double volume(const dataset::Points &points, const Eigen::RowVector4i &tet)
{
  const Eigen::RowVector3d origin = points.row(tet[0]);
  const Eigen::Vector3d a = (points.row(tet[1]) - origin).transpose(), b = (points.row(tet[2]) - origin).transpose();
  return a.cross(b).dot((points.row(tet[3]) - origin).transpose()) / 6;
}
} // namespace

VolumeMesh fill_volume(const TriangleMesh &surface, double size)
{
  try
  {
    const GmshSession session;
    gmsh::model::add("volume");
    add_surface(surface);
    gmsh::model::geo::addSurfaceLoop({1}, 1);
    gmsh::model::geo::addVolume({1}, 1);
    gmsh::model::geo::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMin", size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::model::mesh::generate(3);
    VolumeMesh mesh = read_back(surface);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
      if (volume(mesh.points, mesh.tets.row(t)) < 0)
        std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
    return mesh;
  }
  catch (const ComputationError &)
  {
    throw;
  }
  catch (const std::exception &error)
  {
    throw ComputationError(
        fmt::format("gmsh could not fill a closed surface of {} triangles with tetrahedra of {} mm ({}); "
                    "change the mesh size of the solid organ.",
                    surface.triangles.rows(), size, error.what()));
  }
}

VolumeMesh extrude_wall(const TriangleMesh &surface, double wall)
{
  const auto n = static_cast<std::int32_t>(surface.points.rows());
  VolumeMesh mesh;
  mesh.points.resize(2 * n, 3);
  mesh.points << surface.points, surface.points - wall * surface.normals;
  mesh.tets.resize(3 * surface.triangles.rows(), 4);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
  {
    // Sorted by node: the diagonal of every side wall starts at its smaller outer node, so neighbours agree.
    std::array<std::int32_t, 3> v = {surface.triangles(t, 0), surface.triangles(t, 1), surface.triangles(t, 2)};
    std::sort(v.begin(), v.end());
    const std::array<std::array<std::int32_t, 4>, 3> cut = {
        {{v[0], v[1], v[2], v[2] + n}, {v[0], v[1], v[2] + n, v[1] + n}, {v[0], v[1] + n, v[2] + n, v[0] + n}}};
    const auto [p, q, r] = std::array{surface.triangles(t, 0), surface.triangles(t, 1), surface.triangles(t, 2)};
    const int rotations = (v[0] == p ? (v[1] == q) : v[0] == q ? (v[1] == r) : (v[1] == p));
    for (int k = 0; k < 3; ++k)
    {
      Eigen::RowVector4i tet(cut[static_cast<std::size_t>(k)][0], cut[static_cast<std::size_t>(k)][1],
                             cut[static_cast<std::size_t>(k)][2], cut[static_cast<std::size_t>(k)][3]);
      // The sign follows from the topology, never from the measured volume: a folded wall must stay visible.
      if (rotations == 1)
        std::swap(tet[2], tet[3]);
      mesh.tets.row(3 * t + k) = tet;
    }
  }
  return mesh;
}

double least_volume(const dataset::Points &points, const dataset::Tets &tets)
{
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    least = std::min(least, volume(points, tets.row(t)));
  return least;
}
} // namespace pelvireg::anatomy
