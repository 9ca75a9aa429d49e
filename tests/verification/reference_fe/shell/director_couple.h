// A moment on the end of a shell, carried by its directors.
#pragma once

#include "reference_fe/elements/shell_kinematics.h"
#include "reference_fe/term.h"

#include <Eigen/Geometry>

#include <string>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// Moment factor * m about a fixed axis e on single nodes: virtual work factor m e . (d x delta d) / |d|^2, the moment
/// times the director's virtual rotation. It follows the director: a couple in the plane normal to e turns with it.
/// One item a loaded node; no energy is counted.
class DirectorCouple : public Term
{
public:
  struct LoadedNode
  {
    int first_unknown = 0;                           ///< of the node
    Eigen::Vector3d rest = Eigen::Vector3d::UnitZ(); ///< N
    double moment = 0;                               ///< m, N mm
  };

  /// `axis`: e, unit. `factor_unknown`: the unknown that scales the moments.
  DirectorCouple(std::vector<LoadedNode> nodes, const Eigen::Vector3d &axis, int factor_unknown)
      : nodes_(std::move(nodes)), axis_(axis), factor_unknown_(factor_unknown)
  {
  }

  std::string name() const override { return "director couple"; }
  int n_items() const override { return static_cast<int>(nodes_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override
  {
    const int w = nodes_[item].first_unknown + 3;
    indices = {w, w + 1, w + 2, factor_unknown_};
  }
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override
  {
    unknowns(item, local.unknowns);
    const LoadedNode &node = nodes_[item];
    const Eigen::Vector3d d = node.rest + solution.segment<3>(node.first_unknown + 3), turned = axis_.cross(d);
    const double square = d.squaredNorm(), factor = solution[factor_unknown_];
    Eigen::Matrix3d cross; // e x
    cross << 0, -axis_[2], axis_[1], axis_[2], 0, -axis_[0], -axis_[1], axis_[0], 0;
    local.residual.setZero(4);
    local.residual.head<3>() = -factor * node.moment * turned / square;
    local.tangent.setZero(4, 4);
    local.tangent.topLeftCorner<3, 3>() =
        -factor * node.moment * (cross / square - 2 * turned * d.transpose() / (square * square));
    local.tangent.col(3).head<3>() = -node.moment * turned / square;
    local.energy = 0;
  }

private:
  std::vector<LoadedNode> nodes_;
  Eigen::Vector3d axis_;
  int factor_unknown_;
};
} // namespace pelvireg::reference_fe
