#include "reference_fe/decks/deck_mesh.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace pelvireg::reference_fe
{
namespace
{
/// Corners of the faces of a ten-node tetrahedron in Abaqus' numbering S1 … S4.
constexpr int tetrahedron_faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

void add(DeckPoint &point, int id, double weight)
{
  point.nodes.push_back(id);
  point.weights.push_back(weight);
}
} // namespace

DeckMesh::DeckMesh(const dataset::ReferenceModel &reference, int layers)
{
  number_outer_nodes(reference, layers);
  for (const dataset::ReferenceShell &shell : reference.shells)
  {
    number_inner_nodes(walls_.at(shell.name));
    add_bricks(walls_.at(shell.name));
    for (const std::int32_t node : shell.fixed_nodes)
      fixed_points_.push_back(middle_point(shell.name, node));
  }
  for (const dataset::ReferenceSolid &solid : reference.solids)
  {
    add_tetrahedra(solid);
    for (const std::int32_t node : solid.fixed_nodes)
      fixed_points_.push_back(middle_point(solid.name, node));
  }
  add_bars(reference);
}

DeckMesh::Wall DeckMesh::classified(const dataset::ReferenceShell &shell)
{
  const auto n_nodes = static_cast<std::size_t>(shell.midsurface.rows());
  Wall wall;
  wall.shell = &shell;
  wall.edge.assign(n_nodes, {-1, -1});
  wall.cell.assign(n_nodes, -1);
  std::vector<int> place(n_nodes, -1); // 0 corner, 1 mid-side, 2 centre
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    for (int k = 0; k < 9; ++k)
    {
      const auto node = static_cast<std::size_t>(shell.cells(c, k));
      const int here = k < 4 ? 0 : k < 8 ? 1 : 2;
      if (place[node] >= 0 && (place[node] != here || here == 2))
        throw InputError(
            fmt::format("shell '{}': node {} of cell {} is a corner in one cell and a mid-side or centre in "
                        "another; mend its mesh",
                        shell.name, node, c));
      place[node] = here;
      if (here == 1)
        wall.edge[node] = {shell.cells(c, k - 4), shell.cells(c, (k - 3) % 4)};
      if (here == 2)
        wall.cell[node] = static_cast<int>(c);
    }
  return wall;
}

void DeckMesh::number_outer_nodes(const dataset::ReferenceModel &reference, int layers)
{
  for (const dataset::ReferenceShell &shell : reference.shells)
  {
    Wall wall = classified(shell);
    const auto n_nodes = static_cast<std::size_t>(shell.midsurface.rows());
    wall.id.assign(static_cast<std::size_t>(2 * layers + 1), std::vector<int>(n_nodes, 0));
    for (Eigen::Index n = 0; n < shell.midsurface.rows(); ++n)
    {
      const int id = ++last_node_;
      if (wall.cell[static_cast<std::size_t>(n)] >= 0)
        continue;
      wall.id.back()[static_cast<std::size_t>(n)] = id;
      nodes_[id] = (shell.midsurface.row(n) + 0.5 * shell.thickness[n] * shell.directors.row(n)).transpose();
    }
    walls_[shell.name] = std::move(wall);
  }
  for (const dataset::ReferenceSolid &solid : reference.solids)
  {
    solids_[solid.name] = {&solid, last_node_ + 1};
    for (Eigen::Index n = 0; n < solid.points.rows(); ++n)
      add_node(solid.points.row(n).transpose());
  }
}

void DeckMesh::number_inner_nodes(Wall &wall)
{
  const dataset::ReferenceShell &shell = *wall.shell;
  const int top = static_cast<int>(wall.id.size()) - 1;
  for (int level = 0; level < top; ++level)
    for (Eigen::Index n = 0; n < shell.midsurface.rows(); ++n)
    {
      const auto node = static_cast<std::size_t>(n);
      const bool is_corner = wall.cell[node] < 0 && wall.edge[node].first < 0;
      if (wall.cell[node] >= 0 || (level % 2 == 1 && !is_corner))
        continue;
      const double fibre = 0.5 * shell.thickness[n] * (2. * level / top - 1);
      wall.id[static_cast<std::size_t>(level)][node] =
          add_node((shell.midsurface.row(n) + fibre * shell.directors.row(n)).transpose());
    }
}

void DeckMesh::add_bricks(const Wall &wall)
{
  DeckBody body{wall.shell->name, wall.shell->material, "C3D20R", last_element_ + 1, {}, {}, {}};
  for (Eigen::Index c = 0; c < wall.shell->cells.rows(); ++c)
    for (std::size_t level = 0; level + 2 < wall.id.size(); level += 2)
    {
      std::vector<int> nodes;
      const auto append = [&](std::size_t at, int first)
      {
        for (int k = first; k < first + 4; ++k)
          nodes.push_back(wall.id[at][static_cast<std::size_t>(wall.shell->cells(c, k))]);
      };
      append(level, 0);
      append(level + 2, 0);
      append(level, 4);
      append(level + 2, 4);
      append(level + 1, 0);
      body.elements.push_back(std::move(nodes));
      ++last_element_;
      if (level == 0)
        body.inner_faces.push_back({last_element_, 1});
      if (level + 3 == wall.id.size())
        body.outer_faces.push_back({last_element_, 2});
    }
  bodies_.push_back(std::move(body));
}

void DeckMesh::add_tetrahedra(const dataset::ReferenceSolid &solid)
{
  const int first_node = solids_.at(solid.name).second;
  DeckBody body{solid.name, solid.material, "C3D10", last_element_ + 1, {}, {}, {}};
  std::map<std::array<int, 3>, DeckFace> face_at; // by its corners in ascending order
  const auto sorted = [](std::array<int, 3> corners)
  {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  for (Eigen::Index c = 0; c < solid.cells.rows(); ++c)
  {
    std::vector<int> nodes;
    for (int k = 0; k < 10; ++k)
      nodes.push_back(first_node + solid.cells(c, k));
    body.elements.push_back(std::move(nodes));
    ++last_element_;
    for (int f = 0; f < 4; ++f)
    {
      const auto &corner = tetrahedron_faces[f];
      face_at[sorted({solid.cells(c, corner[0]), solid.cells(c, corner[1]), solid.cells(c, corner[2])})] = {
          last_element_, f + 1};
    }
  }
  for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
  {
    const auto found = face_at.find(sorted({solid.faces(f, 0), solid.faces(f, 1), solid.faces(f, 2)}));
    if (found == face_at.end())
      throw InputError(
          fmt::format("solid '{}': boundary face {} is a face of none of its cells; mend its mesh", solid.name, f));
    body.outer_faces.push_back(found->second);
  }
  bodies_.push_back(std::move(body));
}

void DeckMesh::add_bars(const dataset::ReferenceModel &reference)
{
  first_bar_ = last_element_ + 1;
  const auto rest = [&](const std::string &part, int node) -> Eigen::Vector3d
  {
    const auto wall = walls_.find(part);
    return wall != walls_.end() ? wall->second.shell->midsurface.row(node).transpose()
                                : solids_.at(part).first->points.row(node).transpose();
  };
  for (const dataset::ReferenceTruss &truss : reference.trusses)
  {
    if (truss.tension_only)
      throw InputError(fmt::format("truss group '{}' is slack in compression, which the deck's bars are not; export a "
                                   "case without tension_only",
                                   truss.group));
    DeckBar bar{truss.group, truss.material, truss.area, 0, 0};
    bar.node_a = bar_end(middle_point(truss.part_a, truss.node_a), rest(truss.part_a, truss.node_a));
    if (truss.part_b.empty())
    {
      bar.node_b = add_node(truss.fixed_point);
      fixed_points_.push_back({{bar.node_b}, {1}});
    }
    else
      bar.node_b = bar_end(middle_point(truss.part_b, truss.node_b), rest(truss.part_b, truss.node_b), truss.offset_b);
    bars_.push_back(std::move(bar));
    ++last_element_;
  }
}

DeckPoint DeckMesh::outer_point(const std::string &part, int node) const
{
  const auto wall = walls_.find(part);
  if (wall == walls_.end())
    return {{solids_.at(part).second + node}, {1}};
  return wall_point(wall->second, static_cast<int>(wall->second.id.size()) - 1, node);
}

DeckPoint DeckMesh::middle_point(const std::string &part, int node) const
{
  const auto wall = walls_.find(part);
  if (wall == walls_.end())
    return {{solids_.at(part).second + node}, {1}};
  return wall_point(wall->second, static_cast<int>(wall->second.id.size()) / 2, node);
}

/// Where the deck has no node, the shape functions of the 20-node brick at the middle of a face or of the brick.
DeckPoint DeckMesh::wall_point(const Wall &wall, int level, int node) const
{
  const auto id = [&](int at, int n) { return wall.id[static_cast<std::size_t>(at)][static_cast<std::size_t>(n)]; };
  if (id(level, node) != 0)
    return {{id(level, node)}, {1}};
  DeckPoint point;
  const auto n = static_cast<std::size_t>(node);
  if (wall.cell[n] < 0)
  {
    add(point, id(level - 1, node), 0.5);
    add(point, id(level + 1, node), 0.5);
    for (const int corner : {wall.edge[n].first, wall.edge[n].second})
    {
      add(point, id(level, corner), 0.5);
      add(point, id(level - 1, corner), -0.25);
      add(point, id(level + 1, corner), -0.25);
    }
    return point;
  }
  const auto cell = wall.shell->cells.row(wall.cell[n]);
  for (int k = 0; k < 4; ++k)
    if (level % 2 == 0)
    {
      add(point, id(level, cell[4 + k]), 0.5);
      add(point, id(level, cell[k]), -0.25);
    }
    else
    {
      for (const int at : {level - 1, level + 1})
      {
        add(point, id(at, cell[4 + k]), 0.25);
        add(point, id(at, cell[k]), -0.25);
      }
      add(point, id(level, cell[k]), 0.25);
    }
  return point;
}

int DeckMesh::add_node(const Eigen::Vector3d &position)
{
  nodes_[++last_node_] = position;
  return last_node_;
}

int DeckMesh::bar_end(const DeckPoint &point, const Eigen::Vector3d &rest, const Eigen::Vector3d &offset)
{
  if (point.is_node() && offset.isZero(0))
    return point.nodes.front();
  carried_nodes_.emplace_back(add_node(rest + offset), point);
  return carried_nodes_.back().first;
}
} // namespace pelvireg::reference_fe
