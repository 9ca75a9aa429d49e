// Where a bar of the reference ends on a part: a point of its surface, shared out over the nodes around.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::anatomy
{
/// A surface point and the nodes that carry what is attached there: positive weights, sum 1.
struct BarEnd
{
  Eigen::Vector3d position; ///< mm
  std::vector<std::pair<std::int32_t, double>> nodes;
};

/// The curved mid-surface of a shell or boundary of a solid, searched through triangles an eighth of a cell wide. A bar
/// that ends at a point and not at the nearest node pulls at the same place on every mesh. The point lies on the
/// quadratic cell, not on its chords: a short bar would have another length on every mesh.
class BarSurface
{
public:
  BarSurface(const dataset::ReferenceModel &model, const std::string &part);

  BarEnd closest(const Eigen::Vector3d &point) const;
  Eigen::Vector3d node(std::int32_t index) const { return points_.row(index).transpose(); }

private:
  void add_cell(const dataset::Quads9 &cells, Eigen::Index cell);
  void add_face(const dataset::Triangles6 &faces, Eigen::Index face);

  dataset::Points points_;
  std::vector<BarEnd> samples_;            ///< points of the surface
  std::vector<Eigen::Vector3i> triangles_; ///< between samples
};

/// A piece of a loop of nodes: its middle, as an end for bars, and its length in mm.
struct LoopPart
{
  BarEnd middle;
  double length;
};

/// A closed loop of quadratic edges (corner, middle, corner, ...), each edge in six parts. Equal pulls on all parts of
/// an edge reach its nodes as a uniform pull does, a sixth to a corner and two thirds to the middle: other shares notch
/// it.
std::vector<LoopPart> equal_parts(const dataset::Points &points, const dataset::Integers &loop);
} // namespace pelvireg::anatomy
