// The equation of the load factor past a fold: how far the whole pelvis moves along its own path.
#pragma once

#include "reference_fe/elements/surface_node.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// One row for the load factor: sum_v d_v . (x_v - x_v*) = 0 over points v, with d the direction of the last step and
/// x* the predicted positions (arc length with a normal plane, Riks 1979, over displacements only). Where a wall dents,
/// load and mean vaginal displacement both turn back while the path goes on.
class PathControl : public Term
{
public:
  /// @param points mid-surface or solid nodes (side 0).
  PathControl(std::vector<SurfaceNode> points, int pressure_unknown);

  /// Hold the step onto the plane through `predicted`, normal to `predicted` - `from`.
  void prescribe(const Eigen::VectorXd &from, const Eigen::VectorXd &predicted);
  /// Leave the row to the displacement probe.
  void release() { is_active_ = false; }

  std::string name() const override { return "path control"; }
  int n_items() const override { return static_cast<int>(points_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  std::vector<SurfaceNode> points_;
  int pressure_;
  bool is_active_ = false;
  Eigen::Matrix3Xd predicted_, direction_; ///< a column a point; the direction has unit length over all points
};
} // namespace pelvireg::reference_fe
