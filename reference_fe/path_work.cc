#include "reference_fe/path_work.h"

#include <array>
#include <cmath>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
struct GaussPoint
{
  double at = 0, weight = 0; // on 0 … 1
};

const std::array<GaussPoint, 4> &gauss_points()
{
  static const std::array<GaussPoint, 4> points = []
  {
    std::array<GaussPoint, 4> four;
    for (const int sign : {-1, 1})
    {
      const double inner = std::sqrt(3. / 7 - 2. / 7 * std::sqrt(1.2)),
                   outer = std::sqrt(3. / 7 + 2. / 7 * std::sqrt(1.2));
      four[sign < 0 ? 0 : 3] = {0.5 * (1 + sign * outer), (18 - std::sqrt(30.)) / 72};
      four[sign < 0 ? 1 : 2] = {0.5 * (1 + sign * inner), (18 + std::sqrt(30.)) / 72};
    }
    return four;
  }();
  return points;
}

/// Weights of the older, last and next state for the value and the slope at a point of the way from last to next.
struct Interpolation
{
  std::array<double, 3> value{}, slope{};

  /// `older` < 0: position of the older state where last is 0 and next is `length`; 0: a straight line.
  Interpolation(double older, double length, double at)
  {
    value = {0, 1 - at / length, at / length};
    slope = {0, -1 / length, 1 / length};
    if (older == 0)
      return;
    // Newton's form: the line plus c (s - 0)(s - length), which must meet the older state.
    const double bubble = at * (at - length) / (older * (older - length));
    const double d_bubble = (2 * at - length) / (older * (older - length));
    const std::array<double, 3> line_at_older = {0, 1 - older / length, older / length};
    for (int k = 0; k < 3; ++k)
    {
      value[k] += bubble * ((k == 0 ? 1 : 0) - line_at_older[k]);
      slope[k] += d_bubble * ((k == 0 ? 1 : 0) - line_at_older[k]);
    }
  }
};

template <class Value> Value mix(const std::array<double, 3> &weights, const Value &a, const Value &b, const Value &c)
{
  return weights[0] * a + weights[1] * b + weights[2] * c;
}
} // namespace

PathWork::PathWork(std::shared_ptr<const FollowerPressure> load, std::vector<std::shared_ptr<Cavity>> cavities)
    : load_(std::move(load)), cavities_(std::move(cavities)),
      fluid_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(cavities_.size())))
{
}

PathWork::State PathWork::state_at(const Eigen::VectorXd &solution) const
{
  State state;
  for (const SurfaceFace &face : load_->faces())
    state.faces.push_back(positions(face.nodes, solution));
  state.pressure = solution[load_->pressure_unknown()];
  state.fluid_pressures.resize(fluid_.size());
  state.fluid_volumes.resize(fluid_.size());
  for (Eigen::Index c = 0; c < fluid_.size(); ++c)
  {
    const Cavity &cavity = *cavities_[static_cast<std::size_t>(c)];
    state.fluid_pressures[c] = solution[cavity.pressure_unknown()];
    state.fluid_volumes[c] = cavity.volume(solution);
  }
  return state;
}

Eigen::VectorXd PathWork::works_to(const State &next, bool is_straight) const
{
  const State &last = last_.back(), &older = last_.front(); // one state only: its weight is 0
  const double length = next.at - last.at, before = is_straight ? 0 : older.at - last.at;
  Eigen::VectorXd works = Eigen::VectorXd::Zero(1 + fluid_.size());
  for (const GaussPoint &point : gauss_points())
  {
    const Interpolation way(before, length, point.at * length);
    const double weight = point.weight * length;
    double flux = 0; // rate of the volume that the loaded faces sweep outward
    for (std::size_t f = 0; f < next.faces.size(); ++f)
      flux += swept_rate(mix<Eigen::Matrix3Xd>(way.value, older.faces[f], last.faces[f], next.faces[f]),
                         mix<Eigen::Matrix3Xd>(way.slope, older.faces[f], last.faces[f], next.faces[f]),
                         load_->shares()[f]);
    works[0] -= weight * mix(way.value, older.pressure, last.pressure, next.pressure) * flux;
    const Eigen::VectorXd q =
        mix<Eigen::VectorXd>(way.value, older.fluid_pressures, last.fluid_pressures, next.fluid_pressures);
    const Eigen::VectorXd rate =
        mix<Eigen::VectorXd>(way.slope, older.fluid_volumes, last.fluid_volumes, next.fluid_volumes);
    works.tail(fluid_.size()) -= weight * q.cwiseProduct(rate);
  }
  return works;
}

void PathWork::advance(const Eigen::VectorXd &solution)
{
  State next = state_at(solution);
  if (last_.empty())
    return last_.push_back(std::move(next));
  double moved = 0;
  for (std::size_t f = 0; f < next.faces.size(); ++f)
    moved += (next.faces[f] - last_.back().faces[f]).squaredNorm();
  next.at = last_.back().at + std::sqrt(moved);
  if (next.at == last_.back().at)
    return;
  const Eigen::VectorXd works = works_to(next, false);
  external_ += works[0];
  fluid_ += works.tail(fluid_.size());
  uncertainty_ += (works - works_to(next, true)).lpNorm<1>();
  if (last_.size() == 2)
    last_.erase(last_.begin());
  last_.push_back(std::move(next));
}
} // namespace pelvireg::reference_fe
