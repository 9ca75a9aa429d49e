#include "reference_fe/constraints/tie.h"

#include "reference_fe/contact/closest_point.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
Eigen::Matrix3Xd rest_positions(const SurfaceFace &face)
{
  Eigen::Matrix3Xd x(3, face.nodes.size());
  for (std::size_t i = 0; i < face.nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = face.nodes[i].rest_position();
  return x;
}

struct FoundPoint
{
  double distance = std::numeric_limits<double>::infinity();
  std::size_t face = 0;
  Eigen::VectorXd shape;
};

/// Closest point of the faces at rest, on the facets through their nodes; its shape functions are the curved face's.
FoundPoint find_closest(const std::vector<SurfaceFace> &faces, const Eigen::Vector3d &target)
{
  FoundPoint best;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const Eigen::Matrix3Xd x = rest_positions(faces[f]);
    const int n = static_cast<int>(x.cols());
    for (const std::array<int, 3> &facet : face_facets(n))
    {
      const ClosestPoint found = closest_point(target, x.col(facet[0]), x.col(facet[1]), x.col(facet[2]));
      if (!(found.distance < best.distance))
        continue;
      Eigen::Vector2d at = Eigen::Vector2d::Zero();
      for (int k = 0; k < 3; ++k)
        at += found.barycentric[k] * face_node_coordinates(n, facet[k]);
      best = {found.distance, f, face_shape(n, at.x(), at.y()).value};
    }
  }
  return best;
}
} // namespace

Tie::Tie(std::string name, const std::vector<SurfaceFace> &faces_a, const std::vector<SurfaceFace> &faces_b,
         double stiffness)
    : name_(std::move(name)), stiffness_(stiffness)
{
  for (const SurfaceFace &face : faces_a)
  {
    const Eigen::Matrix3Xd x = rest_positions(face);
    const Eigen::Index n_a = x.cols();
    for (const FacePoint &q : face_quadrature(static_cast<int>(n_a)))
    {
      const Eigen::Vector3d target = x * q.value;
      const FoundPoint found = find_closest(faces_b, target);
      const SurfaceFace &face_b = faces_b[found.face];
      TiedPoint point;
      point.nodes = face.nodes;
      point.nodes.insert(point.nodes.end(), face_b.nodes.begin(), face_b.nodes.end());
      point.weights.resize(n_a + found.shape.size());
      point.weights << q.value, -found.shape;
      point.rest_difference = target - rest_positions(face_b) * found.shape;
      point.area = q.weight * Eigen::Vector3d(x * q.d_xi).cross(x * q.d_eta).norm();
      points_.push_back(std::move(point));
    }
  }
}

Eigen::Vector3d Tie::gap(const TiedPoint &point, const Eigen::VectorXd &solution) const
{
  return positions(point.nodes, solution) * point.weights - point.rest_difference;
}

void Tie::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(points_[item].nodes, indices);
}

void Tie::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  const TiedPoint &point = points_[item];
  unknowns(item, local.unknowns);
  const Eigen::Index n = point.weights.size();
  const double k = stiffness_ * point.area;
  const Eigen::Vector3d opened = gap(point, solution);
  Eigen::VectorXd force(3 * n);
  Eigen::MatrixXd stiffness(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    force.segment<3>(3 * i) = k * point.weights[i] * opened;
    for (Eigen::Index j = 0; j < n; ++j)
      stiffness.block<3, 3>(3 * i, 3 * j) = k * point.weights[i] * point.weights[j] * Eigen::Matrix3d::Identity();
  }
  to_unknowns(point.nodes, solution, force, stiffness, 0, local);
  local.energy = 0.5 * k * opened.squaredNorm();
}

double Tie::opening(const Eigen::VectorXd &solution) const
{
  double largest = 0;
  for (const TiedPoint &point : points_)
    largest = std::max(largest, gap(point, solution).norm());
  return largest;
}

double Tie::rest_gap() const
{
  double largest = 0;
  for (const TiedPoint &point : points_)
    largest = std::max(largest, point.rest_difference.norm());
  return largest;
}
} // namespace pelvireg::reference_fe
