#include "reference_fe/contact/facet_gap.h"

#include "reference_fe/elements/surface_face.h"

#include <Eigen/Geometry>

namespace pelvireg::reference_fe
{
FacetGap facet_gap(const Eigen::Matrix<double, 3, 4> &x)
{
  // In y = x - a, e1 = b - a, e2 = c - a: g = m . y / |m| with m = e1 x e2.
  const Eigen::Vector3d y = x.col(0) - x.col(1), e1 = x.col(2) - x.col(1), e2 = x.col(3) - x.col(1);
  const Eigen::Vector3d m = e1.cross(e2);
  const double length = m.norm();
  const Eigen::Vector3d n = m / length;
  const double g = n.dot(y);
  const Eigen::Vector3d k = (y - g * n) / length; // dg/dm
  const Eigen::Matrix3d p = (Eigen::Matrix3d::Identity() - n * n.transpose()) / length; // dn/dm
  const Eigen::Matrix3d g_mm = -(n * k.transpose() + k * n.transpose() + g * p) / length;
  const Eigen::Matrix3d a1 = -skew(e2), a2 = skew(e1); // dm/de1, dm/de2

  Eigen::Matrix<double, 9, 1> gradient;
  gradient << n, a1.transpose() * k, a2.transpose() * k;
  Eigen::Matrix<double, 9, 9> hessian = Eigen::Matrix<double, 9, 9>::Zero();
  hessian.block<3, 3>(0, 3) = p * a1;
  hessian.block<3, 3>(0, 6) = p * a2;
  hessian.block<3, 3>(3, 6) = a1.transpose() * g_mm * a2 - skew(k);
  hessian.block<3, 3>(3, 0) = hessian.block<3, 3>(0, 3).transpose();
  hessian.block<3, 3>(6, 0) = hessian.block<3, 3>(0, 6).transpose();
  hessian.block<3, 3>(6, 3) = hessian.block<3, 3>(3, 6).transpose();
  hessian.block<3, 3>(3, 3) = a1.transpose() * g_mm * a1;
  hessian.block<3, 3>(6, 6) = a2.transpose() * g_mm * a2;

  Eigen::Matrix<double, 9, 12> to_positions = Eigen::Matrix<double, 9, 12>::Zero();
  to_positions.block<3, 3>(0, 0).setIdentity();
  to_positions.block<3, 3>(3, 6).setIdentity();
  to_positions.block<3, 3>(6, 9).setIdentity();
  for (int i = 0; i < 3; ++i)
    to_positions.block<3, 3>(3 * i, 3) = -Eigen::Matrix3d::Identity();
  return {g, to_positions.transpose() * gradient, to_positions.transpose() * hessian * to_positions};
}
} // namespace pelvireg::reference_fe
