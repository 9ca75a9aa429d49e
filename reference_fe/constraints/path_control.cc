#include "reference_fe/constraints/path_control.h"

#include <utility>

namespace pelvireg::reference_fe
{
PathControl::PathControl(std::vector<SurfaceNode> points, int pressure_unknown)
    : points_(std::move(points)), pressure_(pressure_unknown)
{
}

void PathControl::prescribe(const Eigen::VectorXd &from, const Eigen::VectorXd &predicted)
{
  predicted_ = positions(points_, predicted);
  direction_ = (predicted_ - positions(points_, from)).normalized();
  is_active_ = true;
}

void PathControl::unknowns(int item, std::vector<int> &indices) const
{
  const int first = points_[item].first_unknown;
  indices = {first, first + 1, first + 2, pressure_};
}

void PathControl::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  unknowns(item, local.unknowns);
  local.residual = Eigen::VectorXd::Zero(4);
  local.tangent = Eigen::MatrixXd::Zero(4, 4);
  local.energy = 0;
  if (!is_active_)
    return;
  const Eigen::Vector3d direction = direction_.col(item);
  local.residual[3] = direction.dot(points_[item].position(solution) - predicted_.col(item));
  local.tangent.row(3).head<3>() = direction.transpose();
}
} // namespace pelvireg::reference_fe
