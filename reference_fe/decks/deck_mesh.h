// The reference model as nodes and elements that Abaqus and CalculiX know.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// A material point as a weighted sum of nodes of the deck: its displacement is that sum of theirs.
struct DeckPoint
{
  std::vector<int> nodes; ///< ids
  std::vector<double> weights;

  bool is_node() const { return nodes.size() == 1; }
};

/// A face of an element, numbered as Abaqus does.
struct DeckFace
{
  int element = 0; ///< id
  int number = 0;  ///< 1 … 6: face S<number>
};

/// A shell as bricks, or a solid as tetrahedra.
struct DeckBody
{
  std::string part, material;
  const char *element_type = "";          ///< C3D20R or C3D10
  int first_element = 0;                  ///< id; the others follow
  std::vector<std::vector<int>> elements; ///< ids of the nodes, in Abaqus' order
  std::vector<DeckFace> outer_faces;      ///< of every cell of a shell, of every boundary face of a solid
  std::vector<DeckFace> inner_faces;      ///< of every cell of a shell
};

struct DeckBar
{
  std::string group, material;
  double area = 0; ///< mm^2
  int node_a = 0, node_b = 0;
};

/// Numbering: the outer nodes of the shells and the nodes of the solids (see abaqus_deck()), then the other nodes of
/// the walls, then the ends of bars that lie on no node.
class DeckMesh
{
public:
  /// Throws InputError when a shell's cells disagree on what is a corner, a mid-side or a centre node.
  DeckMesh(const dataset::ReferenceModel &reference, int layers);

  const std::map<int, Eigen::Vector3d> &nodes() const { return nodes_; } ///< id to rest position, mm
  const std::vector<DeckBody> &bodies() const { return bodies_; }
  const std::vector<DeckBar> &bars() const { return bars_; }
  int first_bar() const { return first_bar_; } ///< id of the first bar's element
  const std::vector<DeckPoint> &fixed_points() const { return fixed_points_; }
  /// Nodes of bars that are carried by a point of a wall: id and what carries it.
  const std::vector<std::pair<int, DeckPoint>> &carried_nodes() const { return carried_nodes_; }

  /// Node n of a shell on its outer surface, or of a solid.
  DeckPoint outer_point(const std::string &part, int node) const;
  /// Node n of a shell on its mid-surface, or of a solid.
  DeckPoint middle_point(const std::string &part, int node) const;

private:
  /// Nodes of a shell, level by level from the inner (0) to the outer (2 layers) surface. Odd levels lie inside the
  /// bricks and have corner nodes only.
  struct Wall
  {
    const dataset::ReferenceShell *shell = nullptr;
    std::vector<std::vector<int>> id;      ///< of every level and node, 0: none
    std::vector<std::pair<int, int>> edge; ///< corners of a mid-side node, {-1, -1} for others
    std::vector<int> cell;                 ///< of a centre node, -1 for others
  };
  static Wall classified(const dataset::ReferenceShell &shell);
  void number_outer_nodes(const dataset::ReferenceModel &reference, int layers);
  void number_inner_nodes(Wall &wall);
  void add_bricks(const Wall &wall);
  void add_tetrahedra(const dataset::ReferenceSolid &solid);
  void add_bars(const dataset::ReferenceModel &reference);
  DeckPoint wall_point(const Wall &wall, int level, int node) const;
  int add_node(const Eigen::Vector3d &position);
  /// Node at `rest` + `offset` that moves as `point`, whose own place is `rest`: a node of the wall where it can be.
  int bar_end(const DeckPoint &point, const Eigen::Vector3d &rest,
              const Eigen::Vector3d &offset = Eigen::Vector3d::Zero());

  std::map<int, Eigen::Vector3d> nodes_;
  std::vector<DeckBody> bodies_;
  std::vector<DeckBar> bars_;
  std::vector<DeckPoint> fixed_points_;
  std::vector<std::pair<int, DeckPoint>> carried_nodes_;
  std::map<std::string, Wall> walls_;
  std::map<std::string, std::pair<const dataset::ReferenceSolid *, int>> solids_; ///< and the id of node 0
  int last_node_ = 0, last_element_ = 0, first_bar_ = 0;
};
} // namespace pelvireg::reference_fe
