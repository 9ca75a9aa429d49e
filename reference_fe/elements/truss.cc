#include "reference_fe/elements/truss.h"

#include <algorithm>
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

/// Of a bar at a solution.
struct StretchedBar
{
  double rest_length = 0, length = 0;
  Eigen::Vector3d axis; // unit, from the first node
  UniaxialResponse response;

  StretchedBar(const Bar &bar, const Eigen::VectorXd &solution) : rest_length(rest_vector(bar).norm())
  {
    const Eigen::Vector3d end = bar.nodes.size() == 2 ? bar.nodes[1].position(solution) : bar.fixed_end;
    const Eigen::Vector3d span = end - bar.nodes[0].position(solution);
    length = span.norm();
    axis = span / length;
    const auto law = bar.tension_only ? tension_only_response : uniaxial_response;
    response = law(bar.material, length / rest_length);
  }
};
} // namespace

UniaxialResponse uniaxial_response(const dataset::YeohMaterial &m, double lambda)
{
  const double e = lambda * lambda + 2 / lambda - 3;
  const double w1 = m.c10 + 2 * m.c20 * e + 3 * m.c30 * e * e, w2 = 2 * m.c20 + 6 * m.c30 * e;
  const double d1 = 2 * (lambda - 1 / (lambda * lambda)), d2 = 2 + 4 / (lambda * lambda * lambda);
  return {m.c10 * e + m.c20 * e * e + m.c30 * e * e * e, w1 * d1, w1 * d2 + w2 * d1 * d1};
}

UniaxialResponse tension_only_response(const dataset::YeohMaterial &m, double lambda)
{
  const double strain = lambda - 1, t = std::clamp(strain / tension_only_width, 0., 1.);
  const double slope = t * t * (3 - 2 * t), curvature = 6 * t * (1 - t) / tension_only_width;
  const double taut = tension_only_width * t * t * t * (1 - t / 2) + std::max(strain - tension_only_width, 0.);
  const UniaxialResponse response = uniaxial_response(m, 1 + taut);
  const double remainder = tension_only_remainder * 6 * m.c10;
  return {response.energy + remainder / 2 * strain * strain, response.stress * slope + remainder * strain,
          response.modulus * slope * slope + response.stress * curvature + remainder};
}

double bar_energy(const Bar &bar, const Eigen::VectorXd &solution)
{
  const StretchedBar state(bar, solution);
  return bar.area * state.rest_length * state.response.energy;
}

Eigen::Vector3d bar_pull(const Bar &bar, const Eigen::VectorXd &solution)
{
  const StretchedBar state(bar, solution);
  return bar.area * state.response.stress * state.axis;
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
  const StretchedBar state(bar, solution);

  const Eigen::Vector3d pull = bar.area * state.response.stress * state.axis;
  const Eigen::Matrix3d along = state.axis * state.axis.transpose();
  const Eigen::Matrix3d stiffness =
      bar.area * state.response.modulus / state.rest_length * along +
      bar.area * state.response.stress / state.length * (Eigen::Matrix3d::Identity() - along);
  local.energy = bar.area * state.rest_length * state.response.energy;
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
