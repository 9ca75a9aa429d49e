#include "reference_fe/elements/truss.h"

#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
Eigen::Vector3d rest_vector(const Bar &bar)
{
  const Eigen::Vector3d end = bar.nodes.size() == 2 ? bar.nodes[1].rest_position() : bar.fixed_end;
  return end - bar.nodes[0].rest_position();
}
} // namespace

UniaxialResponse uniaxial_response(const dataset::YeohMaterial &m, double lambda)
{
  const double e = lambda * lambda + 2 / lambda - 3;
  const double w1 = m.c10 + 2 * m.c20 * e + 3 * m.c30 * e * e, w2 = 2 * m.c20 + 6 * m.c30 * e;
  const double d1 = 2 * (lambda - 1 / (lambda * lambda)), d2 = 2 + 4 / (lambda * lambda * lambda);
  return {m.c10 * e + m.c20 * e * e + m.c30 * e * e * e, w1 * d1, w1 * d2 + w2 * d1 * d1};
}

Trusses::Trusses(std::vector<Bar> bars) : bars_(std::move(bars)) {}

void Trusses::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(bars_[item].nodes, indices);
}

void Trusses::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  const Bar &bar = bars_[item];
  unknowns(item, local.unknowns);
  const bool two_nodes = bar.nodes.size() == 2;
  const double rest_length = rest_vector(bar).norm();
  const Eigen::Vector3d end = two_nodes ? bar.nodes[1].position(solution) : bar.fixed_end;
  const Eigen::Vector3d span = end - bar.nodes[0].position(solution);
  const double length = span.norm();
  const Eigen::Vector3d axis = span / length;
  const UniaxialResponse response = uniaxial_response(bar.material, length / rest_length);

  const Eigen::Vector3d pull = bar.area * response.stress * axis;
  const Eigen::Matrix3d along = axis * axis.transpose();
  const Eigen::Matrix3d stiffness = bar.area * response.modulus / rest_length * along +
                                    bar.area * response.stress / length * (Eigen::Matrix3d::Identity() - along);
  local.energy = bar.area * rest_length * response.energy;
  const int n = two_nodes ? 6 : 3;
  local.residual.resize(n);
  local.tangent.resize(n, n);
  local.residual.head<3>() = -pull;
  local.tangent.topLeftCorner<3, 3>() = stiffness;
  if (!two_nodes)
    return;
  local.residual.tail<3>() = pull;
  local.tangent.bottomRightCorner<3, 3>() = stiffness;
  local.tangent.topRightCorner<3, 3>() = -stiffness;
  local.tangent.bottomLeftCorner<3, 3>() = -stiffness;
}
} // namespace pelvireg::reference_fe
