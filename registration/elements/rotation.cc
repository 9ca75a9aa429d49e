#include "registration/elements/rotation.h"

#include <Eigen/Dense>

#include <cmath>

namespace pelvireg::registration
{
namespace
{
Eigen::Matrix3d cofactor(const Eigen::Matrix3d &m)
{
  Eigen::Matrix3d result;
  result.col(0) = m.col(1).cross(m.col(2));
  result.col(1) = m.col(2).cross(m.col(0));
  result.col(2) = m.col(0).cross(m.col(1));
  return result;
}

Eigen::Matrix3d nearest_proper_rotation(const Eigen::Matrix3d &m)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0)
    u.col(2) = -u.col(2); // singular values are sorted: the last is the smallest
  return u * svd.matrixV().transpose();
}
} // namespace

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d &deformation_gradient)
{
  // Below this relative determinant the Newton iteration loses digits to cancellation in the inverse.
  constexpr double flat = 1e-6;
  constexpr int max_iterations = 30;
  Eigen::Matrix3d q = deformation_gradient;
  double determinant = q.determinant();
  const double scale = q.norm();
  if (!(determinant > flat * scale * scale * scale))
    return nearest_proper_rotation(deformation_gradient);

  for (int i = 0; i < max_iterations; ++i)
  {
    const Eigen::Matrix3d inverse_transpose = cofactor(q) / determinant;
    const double gamma = std::sqrt(inverse_transpose.norm() / q.norm());
    const Eigen::Matrix3d next = 0.5 * (gamma * q + inverse_transpose / gamma);
    const double squared_change = (next - q).squaredNorm();
    q = next;
    // Convergence is quadratic: after a change of 1e-8 the error is at round-off.
    if (squared_change < 1e-16)
      return q;
    determinant = q.determinant();
  }
  return nearest_proper_rotation(deformation_gradient);
}
} // namespace pelvireg::registration
