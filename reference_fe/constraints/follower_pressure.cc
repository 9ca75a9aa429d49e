#include "reference_fe/constraints/follower_pressure.h"

#include <utility>

namespace pelvireg::reference_fe
{
FollowerPressure::FollowerPressure(std::vector<SurfaceFace> faces, int pressure_unknown,
                                   std::vector<Eigen::VectorXd> shares)
    : faces_(std::move(faces)), shares_(std::move(shares)), pressure_(pressure_unknown)
{
  if (shares_.empty())
    for (const SurfaceFace &face : faces_)
      shares_.push_back(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(face.nodes.size())));
}

void FollowerPressure::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(faces_[item].nodes, indices);
  indices.push_back(pressure_);
}

void FollowerPressure::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  unknowns(item, local.unknowns);
  const std::vector<SurfaceNode> &nodes = faces_[item].nodes;
  const int n = static_cast<int>(nodes.size());
  const Eigen::Matrix3Xd x = positions(nodes, solution);
  const double p = solution[pressure_];
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * n + 1);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * n + 1, 3 * n + 1);
  for (const FacePoint &q : face_quadrature(n))
  {
    const Eigen::Vector3d g1 = x * q.d_xi, g2 = x * q.d_eta;
    const double weight = q.weight * q.value.dot(shares_[item]);
    const Eigen::Vector3d normal = weight * g1.cross(g2);
    const Eigen::Matrix3d s1 = weight * p * skew(g1), s2 = weight * p * skew(g2);
    for (int j = 0; j < n; ++j)
    {
      const Eigen::Matrix3d d_normal = q.d_eta[j] * s1 - q.d_xi[j] * s2;
      for (int i = 0; i < n; ++i)
        stiffness.block<3, 3>(3 * i, 3 * j) += q.value[i] * d_normal;
      stiffness.block<3, 1>(3 * j, 3 * n) += q.value[j] * normal;
    }
  }
  force.head(3 * n) = p * stiffness.col(3 * n).head(3 * n);
  to_unknowns(nodes, solution, force, stiffness, 1, local);
  local.energy = 0;
}

Eigen::Vector3d FollowerPressure::resultant(const Eigen::VectorXd &solution) const
{
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < faces_.size(); ++f)
  {
    const Eigen::Matrix3Xd x = positions(faces_[f].nodes, solution);
    for (const FacePoint &q : face_quadrature(static_cast<int>(x.cols())))
      area += q.weight * q.value.dot(shares_[f]) * Eigen::Vector3d(x * q.d_xi).cross(x * q.d_eta);
  }
  return -solution[pressure_] * area;
}

double swept_rate(const Eigen::Matrix3Xd &positions, const Eigen::Matrix3Xd &velocities, const Eigen::VectorXd &shares)
{
  double rate = 0;
  for (const FacePoint &q : face_quadrature(static_cast<int>(positions.cols())))
    rate += q.weight * q.value.dot(shares) *
            (velocities * q.value).dot(Eigen::Vector3d(positions * q.d_xi).cross(positions * q.d_eta));
  return rate;
}
} // namespace pelvireg::reference_fe
