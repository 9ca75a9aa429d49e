#include "registration/elements/hexahedron.h"

#include "registration/elements/rotation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelvireg::registration
{
namespace
{
using NodalVectors = Hexahedron::NodalVectors;

/// Corners of the reference cube in VTK order.
NodalVectors reference_corners()
{
  NodalVectors corners;
  corners << -1, 1, 1, -1, -1, 1, 1, -1, //
      -1, -1, 1, 1, -1, -1, 1, 1,        //
      -1, -1, -1, -1, 1, 1, 1, 1;
  return corners;
}

double shape(int a, const Eigen::Vector3d &xi)
{
  static const NodalVectors corners = reference_corners();
  return 0.125 * (1 + corners(0, a) * xi[0]) * (1 + corners(1, a) * xi[1]) * (1 + corners(2, a) * xi[2]);
}

/// Gradients of the shape functions on the reference cube.
NodalVectors shape_gradients(const Eigen::Vector3d &xi)
{
  static const NodalVectors corners = reference_corners();
  NodalVectors gradients;
  for (int a = 0; a < Hexahedron::n_nodes; ++a)
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      gradients(i, a) = 0.125 * corners(i, a) * (1 + corners(j, a) * xi[j]) * (1 + corners(k, a) * xi[k]);
    }
  return gradients;
}

Eigen::Matrix3d jacobian(const NodalVectors &rest, const Eigen::Vector3d &xi)
{
  return rest * shape_gradients(xi).transpose(); // dX_i / dxi_j
}

using StrainColumns = Eigen::Matrix<double, 6, 3>;
using Strain33 = Eigen::Matrix<double, 6, 33>;

/// Strain (xx, yy, zz, 2xy, 2yz, 2zx) of a displacement field with gradient g.
StrainColumns strain_columns(const Eigen::Vector3d &g)
{
  StrainColumns b;
  b << g[0], 0, 0, //
      0, g[1], 0,  //
      0, 0, g[2],  //
      g[1], g[0], 0, 0, g[2], g[1], g[2], 0, g[0];
  return b;
}

/// Strain of the 8 nodes and the 3 modes 1 - xi_m^2. The modes' gradients use the Jacobian of the centre, scaled by the
/// ratio of determinants, so that they do no work on a constant stress and the patch test holds.
Strain33 strain_matrix(const NodalVectors &rest, const Eigen::Vector3d &xi, double determinant)
{
  const Eigen::Matrix3d inverse = jacobian(rest, xi).inverse();
  const NodalVectors gradients = inverse.transpose() * shape_gradients(xi);
  const Eigen::Matrix3d centre = jacobian(rest, Eigen::Vector3d::Zero());
  const Eigen::Matrix3d centre_inverse = centre.inverse() * (centre.determinant() / determinant);
  Strain33 b;
  for (int a = 0; a < Hexahedron::n_nodes; ++a)
    b.middleCols<3>(3 * a) = strain_columns(gradients.col(a));
  for (int m = 0; m < 3; ++m)
    b.middleCols<3>(24 + 3 * m) = strain_columns(-2 * xi[m] * centre_inverse.row(m).transpose());
  return b;
}

Eigen::Matrix<double, 6, 6> elasticity_matrix(const Lame &material)
{
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(material.lambda);
  c.diagonal().head<3>().array() += 2 * material.mu;
  c.diagonal().tail<3>().setConstant(material.mu);
  return c;
}
} // namespace

Hexahedron::Hexahedron(const NodalVectors &rest, const Lame &material) : rest_(rest), material_(material)
{
  const double g = 1 / std::sqrt(3.0);
  const NodalVectors gauss_points = g * reference_corners();
  const Eigen::Matrix<double, 6, 6> c = elasticity_matrix(material);
  Eigen::Matrix<double, 33, 33> full = Eigen::Matrix<double, 33, 33>::Zero();
  volume_shares_.setZero();
  for (int q = 0; q < n_nodes; ++q)
  {
    const Eigen::Vector3d xi = gauss_points.col(q);
    const double determinant = jacobian(rest, xi).determinant();
    const Strain33 b = strain_matrix(rest, xi, determinant);
    full.noalias() += determinant * (b.transpose() * c * b);
    for (int a = 0; a < n_nodes; ++a)
      volume_shares_[a] += determinant * shape(a, xi);
  }
  const Eigen::Matrix<double, 9, 24> coupling = full.bottomLeftCorner<9, 24>();
  const Eigen::Matrix<double, 9, 9> modes = full.bottomRightCorner<9, 9>();
  const Stiffness condensed = full.topLeftCorner<24, 24>() - coupling.transpose() * modes.llt().solve(coupling);
  stiffness_ = 0.5 * (condensed + condensed.transpose());
  const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  centre_gradients_ = jacobian(rest, centre).inverse().transpose() * shape_gradients(centre);
}

double Hexahedron::least_jacobian(const NodalVectors &rest)
{
  const NodalVectors corners = reference_corners();
  double least = std::numeric_limits<double>::infinity();
  for (int q = 0; q < n_nodes; ++q)
    least = std::min(least, jacobian(rest, corners.col(q)).determinant());
  return least;
}

Eigen::Matrix3d Hexahedron::rotation(const NodalVectors &positions) const
{
  return rotation_of(positions * centre_gradients_.transpose());
}

Hexahedron::NodalVectors Hexahedron::force(const Eigen::Matrix3d &rotation, const NodalVectors &positions) const
{
  const NodalVectors displacement = rotation.transpose() * positions - rest_;
  const Eigen::Map<const Eigen::Matrix<double, 24, 1>> u(displacement.data());
  NodalVectors result;
  Eigen::Map<Eigen::Matrix<double, 24, 1>>(result.data()).noalias() = stiffness_ * u;
  return rotation * result;
}

Eigen::Matrix<double, 8, 8> Hexahedron::tension_stiffness(const Eigen::Matrix3d &rotation,
                                                          const NodalVectors &positions) const
{
  const Eigen::Matrix3d stretch = rotation.transpose() * (positions * centre_gradients_.transpose());
  const Eigen::Matrix3d strain = 0.5 * (stretch + stretch.transpose()) - Eigen::Matrix3d::Identity();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal;
  principal.computeDirect(2 * material_.mu * strain + material_.lambda * strain.trace() * Eigen::Matrix3d::Identity());
  const NodalVectors along = principal.eigenvectors().transpose() * centre_gradients_;
  return volume() * (along.transpose() * principal.eigenvalues().cwiseMax(0).asDiagonal() * along);
}
} // namespace pelvireg::registration
