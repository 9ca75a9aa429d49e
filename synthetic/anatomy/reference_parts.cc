#include "synthetic/anatomy/reference_parts.h"

#include "synthetic/anatomy/volume_mesh.h"
#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace pelvireg::anatomy
{
using dataset::Integers;
using dataset::Points;

namespace
{
Integers joined(const std::vector<Integers> &loops)
{
  std::vector<std::int32_t> nodes;
  for (const Integers &loop : loops)
    nodes.insert(nodes.end(), loop.data(), loop.data() + loop.size());
  std::sort(nodes.begin(), nodes.end());
  return Eigen::Map<const Integers>(nodes.data(), static_cast<Eigen::Index>(nodes.size()));
}

using Edge = std::pair<std::int32_t, std::int32_t>;
Edge edge_of(std::int32_t a, std::int32_t b)
{
  return {std::min(a, b), std::max(a, b)};
}

double length(const Integers &loop, const Points &points)
{
  double sum = 0;
  for (Eigen::Index i = 0; i < loop.size(); ++i)
    sum += (points.row(loop[i]) - points.row(loop[(i + 1) % loop.size()])).norm();
  return sum;
}

/// The bony edge, which is the longer loop, and all that turns over it from there; the hiatus is free.
Integers held_floor_nodes(const dataset::ReferenceShell &floor, const std::vector<Integers> &loops, const Chart &bowl)
{
  const Integers &edge = *std::max_element(loops.begin(), loops.end(),
                                           [&](const Integers &a, const Integers &b)
                                           { return length(a, floor.midsurface) < length(b, floor.midsurface); });
  std::set<std::int32_t> held(edge.begin(), edge.end());
  for (Eigen::Index cell = static_cast<Eigen::Index>(bowl.n_a) * bowl.n_b; cell < floor.cells.rows(); ++cell)
    held.insert(floor.cells.row(cell).begin(), floor.cells.row(cell).end());
  const std::vector<std::int32_t> nodes(held.begin(), held.end());
  return Eigen::Map<const Integers>(nodes.data(), static_cast<Eigen::Index>(nodes.size()));
}

/// Curved boundary of the solid: two quadratic triangles a cell of the quadratic mesh, nodes of that mesh.
dataset::Triangles6 boundary_faces(const QuadraticMesh &surface, Integers &region)
{
  dataset::Triangles6 faces(2 * surface.cells.rows(), 6);
  region.resize(faces.rows());
  for (Eigen::Index c = 0; c < surface.cells.rows(); ++c)
  {
    const auto q = surface.cells.row(c);
    faces.row(2 * c) << q[0], q[1], q[2], q[4], q[5], q[8];
    faces.row(2 * c + 1) << q[0], q[2], q[3], q[8], q[6], q[7];
    region[2 * c] = region[2 * c + 1] = surface.region[c];
  }
  return faces;
}

/// The corner triangles of the boundary faces as a closed linear surface; `original` maps its nodes back.
TriangleMesh corner_surface(const QuadraticMesh &surface, const dataset::Triangles6 &faces,
                            std::vector<std::int32_t> &original)
{
  std::map<std::int32_t, std::int32_t> index_of;
  TriangleMesh mesh;
  mesh.triangles.resize(faces.rows(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
    {
      const auto [entry, is_new] = index_of.try_emplace(faces(f, k), static_cast<std::int32_t>(original.size()));
      if (is_new)
        original.push_back(faces(f, k));
      mesh.triangles(f, k) = entry->second;
    }
  mesh.points.resize(static_cast<Eigen::Index>(original.size()), 3);
  for (std::size_t i = 0; i < original.size(); ++i)
    mesh.points.row(static_cast<Eigen::Index>(i)) = surface.points.row(original[i]);
  return mesh;
}

/// Least Jacobian of a quadratic tetrahedron at its ten nodes, relative to the straight one's.
double relative_jacobian(const Points &points, const Eigen::Matrix<std::int32_t, 1, 10> &cell)
{
  static const double at[10][3] = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
                                   {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};
  Eigen::Matrix<double, 10, 3> x;
  for (int k = 0; k < 10; ++k)
    x.row(k) = points.row(cell[k]);
  Eigen::Matrix3d straight;
  straight << x.row(1) - x.row(0), x.row(2) - x.row(0), x.row(3) - x.row(0);
  double least = 1;
  for (const auto &p : at)
  {
    const double r = p[0], s = p[1], t = p[2], l = 1 - r - s - t;
    Eigen::Matrix<double, 3, 10> slopes; // d shape / d (r, s, t); nodes: corners, 01, 12, 02, 03, 13, 23
    slopes << 1 - 4 * l, 4 * r - 1, 0, 0, 4 * (l - r), 4 * s, -4 * s, -4 * t, 4 * t, 0, //
        1 - 4 * l, 0, 4 * s - 1, 0, -4 * r, 4 * r, 4 * (l - s), -4 * t, 0, 4 * t,       //
        1 - 4 * l, 0, 0, 4 * t - 1, -4 * r, 0, -4 * s, 4 * (l - t), 4 * r, 4 * s;
    least = std::min(least, (slopes * x).determinant() / straight.determinant());
  }
  return least;
}

constexpr double least_allowed_jacobian = 0.2; // of the straight tetrahedron's: good enough for quadrature

/// A tetrahedron squeezed between two curved faces at the sharp rim of the patch may fold: its mid-side nodes go back
/// towards the straight edges, by halves, until it does not. Returns the least relative Jacobian that is left.
double unfold(const dataset::Tets10 &cells, Points &points)
{
  static const int edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  double least = 0;
  for (int round = 0; round < 12 && !(least >= least_allowed_jacobian); ++round)
  {
    least = 1;
    for (Eigen::Index c = 0; c < cells.rows(); ++c)
    {
      const double jacobian = relative_jacobian(points, cells.row(c));
      least = std::min(least, jacobian);
      for (int k = 0; k < 6 && jacobian < least_allowed_jacobian; ++k)
        points.row(cells(c, 4 + k)) = points.row(cells(c, 4 + k)) / 2 +
                                      (points.row(cells(c, edges[k][0])) + points.row(cells(c, edges[k][1]))) / 4;
    }
  }
  return least;
}
} // namespace

dataset::ReferenceShell make_shell(const std::string &name, const std::string &material,
                                   const std::vector<Chart> &charts, double thickness, double offset)
{
  const QuadraticMesh mesh = quadratic_mesh(charts);
  dataset::ReferenceShell shell;
  shell.name = name;
  shell.material = material;
  shell.midsurface = mesh.points + offset * thickness * mesh.normals;
  shell.directors = mesh.normals;
  shell.thickness = Eigen::VectorXd::Constant(mesh.points.rows(), thickness);
  shell.cells = mesh.cells;
  shell.region = mesh.region;
  shell.pressure_share = mesh.pressure_share;
  return shell;
}

dataset::ReferenceSolid make_solid(const std::string &name, const std::string &material,
                                   const std::vector<Chart> &charts, double size)
{
  const QuadraticMesh surface = quadratic_mesh(charts);
  dataset::ReferenceSolid solid;
  solid.name = name;
  solid.material = material;
  solid.faces = boundary_faces(surface, solid.region);
  std::vector<std::int32_t> original; // node of the linear volume -> node of the solid
  const TriangleMesh corners = corner_surface(surface, solid.faces, original);
  const VolumeMesh volume = fill_volume(corners, size);

  std::vector<Eigen::RowVector3d> points;
  for (Eigen::Index i = 0; i < surface.points.rows(); ++i)
    points.push_back(surface.points.row(i));
  for (Eigen::Index i = corners.points.rows(); i < volume.points.rows(); ++i)
  {
    original.push_back(static_cast<std::int32_t>(points.size()));
    points.push_back(volume.points.row(i));
  }
  std::map<Edge, std::int32_t> middle_of;
  for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      middle_of[edge_of(solid.faces(f, k), solid.faces(f, (k + 1) % 3))] = solid.faces(f, 3 + k);

  solid.cells.resize(volume.tets.rows(), 10);
  static const int edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  for (Eigen::Index c = 0; c < volume.tets.rows(); ++c)
  {
    for (int k = 0; k < 4; ++k)
      solid.cells(c, k) = original[static_cast<std::size_t>(volume.tets(c, k))];
    for (int k = 0; k < 6; ++k)
    {
      const std::int32_t a = solid.cells(c, edges[k][0]), b = solid.cells(c, edges[k][1]);
      const auto [entry, is_new] = middle_of.try_emplace(edge_of(a, b), static_cast<std::int32_t>(points.size()));
      if (is_new)
        points.push_back((points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]) / 2);
      solid.cells(c, 4 + k) = entry->second;
    }
  }
  solid.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    solid.points.row(static_cast<Eigen::Index>(i)) = points[i];
  solid.pressure_share = Eigen::VectorXd::Zero(solid.points.rows());
  solid.pressure_share.head(surface.points.rows()) = surface.pressure_share;
  const double least = unfold(solid.cells, solid.points);
  if (!(least > 0))
    throw ComputationError(
        fmt::format("The quadratic tetrahedra of the {} are inverted (least relative Jacobian {:.3g}); "
                    "lower reference.cell_size.{}.",
                    name, least, name));
  return solid;
}

dataset::ReferenceModel make_reference(const Parameters &p)
{
  dataset::ReferenceModel model;
  model.materials = p.materials;
  model.target_displacement = p.target_displacement;
  model.n_increments = p.n_increments;
  const auto size = [&](const std::string &part) { return p.cell_size.at(part); };
  const auto material = [&](const std::string &part) { return p.material_of.at(part); };
  model.shells.push_back(
      make_shell("bladder", material("bladder"), bladder_charts(p.bladder, size("bladder")), p.bladder.wall, -0.5));
  model.shells.push_back(
      make_shell("vagina", material("vagina"), vagina_charts(p.vagina, p.uterus, size("vagina")), p.vagina.wall, -0.5));
  model.shells.push_back(
      make_shell("rectum", material("rectum"), rectum_charts(p.rectum, size("rectum")), p.rectum.wall, -0.5));
  const std::vector<Chart> floor = floor_charts(p.pelvic_floor, size("pelvic_floor"));
  model.shells.push_back(make_shell("pelvic_floor", material("pelvic_floor"), floor, p.pelvic_floor.thickness, 0));
  for (dataset::ReferenceShell &shell : model.shells)
  {
    const std::vector<Integers> loops = boundary_loops(shell.cells);
    if (shell.name != "pelvic_floor")
    {
      shell.rims = loops;
      shell.fixed_nodes = joined(loops);
      const auto filling = p.cavities.find(shell.name);
      shell.has_cavity = filling == p.cavities.end() || !filling->second.is_open;
      if (filling != p.cavities.end())
        shell.cavity = filling->second.control;
      continue;
    }
    shell.fixed_nodes = held_floor_nodes(shell, loops, floor.front());
  }
  model.solids.push_back(
      make_solid("uterus", material("uterus"), uterus_charts(p.uterus, p.vagina, size("uterus")), size("uterus")));
  model.contact_pairs = {{"bladder", "vagina"},     {"bladder", "uterus"},       {"vagina", "rectum"},
                         {"uterus", "rectum"},      {"bladder", "pelvic_floor"}, {"vagina", "pelvic_floor"},
                         {"rectum", "pelvic_floor"}};
  model.ties = {{"vagina", "uterus"}};
  model.trusses = make_bars(p, model);
  return model;
}
} // namespace pelvireg::anatomy
