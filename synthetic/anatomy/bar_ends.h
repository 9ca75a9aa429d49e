// Where a bar of the reference ends on a part: a point of its surface, shared out over the nodes around.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pelvireg::anatomy
{
/// A surface point and the nodes that carry what is attached there: barycentric weights, positive, sum 1.
struct BarEnd
{
  Eigen::Vector3d position; ///< mm
  std::vector<std::pair<std::int32_t, double>> nodes;
};

/// The mid-surface of a shell or the boundary of a solid, each quadratic face cut into triangles between its nodes. A
/// bar that ends at a point and not at the nearest node pulls at the same place on every mesh.
class BarSurface
{
public:
  BarSurface(const dataset::ReferenceModel &model, const std::string &part);

  BarEnd closest(const Eigen::Vector3d &point) const;
  Eigen::Vector3d node(std::int32_t index) const { return points_.row(index).transpose(); }

private:
  dataset::Points points_;
  std::vector<Eigen::Vector3i> triangles_;
};
} // namespace pelvireg::anatomy
