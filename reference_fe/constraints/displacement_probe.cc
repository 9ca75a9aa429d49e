#include "reference_fe/constraints/displacement_probe.h"

#include "synthetic/dataset/error.h"

#include <map>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
/// A vertex exactly in the plane counts as left of it: every triangle is cut in two edges or in none.
bool is_left(double distance)
{
  return distance >= 0;
}

/// Where edge (a, b) crosses the plane: weights of a and b.
Eigen::Vector2d crossing(double distance_a, double distance_b)
{
  const double t = distance_a / (distance_a - distance_b);
  return {1 - t, t};
}
} // namespace

std::vector<ProbePoint> probe_points(const std::vector<SurfaceNode> &vertices, const dataset::Triangles &triangles,
                                     const dataset::Integers &region, const dataset::Plane &plane)
{
  const auto distance = [&](int v) { return (vertices[v].rest_position() - plane.origin).dot(plane.normal); };
  std::map<std::pair<int, int>, ProbePoint> cut_edges;
  double total = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    if (region[t] == static_cast<std::int32_t>(dataset::SurfaceRegion::cap))
      continue;
    std::vector<std::pair<ProbePoint *, Eigen::Vector3d>> ends;
    for (int k = 0; k < 3; ++k)
    {
      const int a = std::min(triangles(t, k), triangles(t, (k + 1) % 3)),
                b = triangles(t, k) + triangles(t, (k + 1) % 3) - a;
      if (is_left(distance(a)) == is_left(distance(b)))
        continue;
      ProbePoint &point = cut_edges[{a, b}];
      point.nodes = {vertices[a], vertices[b]};
      point.weights = crossing(distance(a), distance(b));
      ends.emplace_back(&point, point.weights[0] * vertices[a].rest_position() +
                                    point.weights[1] * vertices[b].rest_position());
    }
    if (ends.size() != 2)
      continue;
    const double length = (ends[0].second - ends[1].second).norm();
    ends[0].first->share += 0.5 * length;
    ends[1].first->share += 0.5 * length;
    total += length;
  }
  if (!(total > 0))
    throw InputError("the DYN plane does not cut the vagina's outer surface, so the load cannot be controlled by its "
                     "displacement; move the plane's origin or normal");
  std::vector<ProbePoint> points;
  for (const auto &[edge, point] : cut_edges)
  {
    points.push_back(point);
    points.back().share /= total;
  }
  return points;
}

DisplacementProbe::DisplacementProbe(std::vector<ProbePoint> points, const Eigen::Vector3d &plane_normal,
                                     int pressure_unknown)
    : points_(std::move(points)),
      projection_(Eigen::Matrix3d::Identity() - plane_normal.normalized() * plane_normal.normalized().transpose()),
      pressure_(pressure_unknown)
{
}

void DisplacementProbe::prescribe_pressure(double pressure)
{
  control_ = Control::pressure;
  target_ = pressure;
}

void DisplacementProbe::prescribe_displacement(double displacement)
{
  control_ = Control::displacement;
  target_ = displacement;
}

Eigen::Vector3d DisplacementProbe::in_plane_displacement(const ProbePoint &point, const Eigen::VectorXd &solution) const
{
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  for (int k = 0; k < 2; ++k)
    displacement += point.weights[k] * (point.nodes[k].position(solution) - point.nodes[k].rest_position());
  return projection_ * displacement;
}

double DisplacementProbe::mean_displacement(const Eigen::VectorXd &solution) const
{
  double mean = 0;
  for (const ProbePoint &point : points_)
    mean += point.share * in_plane_displacement(point, solution).norm();
  return mean;
}

void DisplacementProbe::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  if (item < static_cast<int>(points_.size()))
    append_unknowns(points_[item].nodes, indices);
  indices.push_back(pressure_);
}

void DisplacementProbe::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  unknowns(item, local.unknowns);
  local.energy = 0;
  const bool is_last = item == static_cast<int>(points_.size());
  if (is_last || control_ != Control::displacement)
  {
    const Eigen::Index n = static_cast<Eigen::Index>(local.unknowns.size());
    local.residual = Eigen::VectorXd::Zero(n);
    local.tangent = Eigen::MatrixXd::Zero(n, n);
    if (!is_last || control_ == Control::none)
      return;
    local.residual[0] = (control_ == Control::pressure ? solution[pressure_] : 0) - target_;
    local.tangent(0, 0) = control_ == Control::pressure ? 1 : 0;
    return;
  }
  const ProbePoint &point = points_[item];
  const Eigen::Vector3d displacement = in_plane_displacement(point, solution);
  const double norm = displacement.norm();
  const Eigen::Vector3d direction = norm > 0 ? Eigen::Vector3d(displacement / norm) : Eigen::Vector3d::Zero();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(7);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(7, 7);
  force[6] = point.share * norm;
  for (int k = 0; k < 2; ++k)
    stiffness.block<1, 3>(6, 3 * k) = point.share * point.weights[k] * direction.transpose();
  to_unknowns(point.nodes, solution, force, stiffness, 1, local);
}
} // namespace pelvireg::reference_fe
