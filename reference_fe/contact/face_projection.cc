#include "reference_fe/contact/face_projection.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
/// Value, first and second derivative of the Lagrange polynomials at -1, 0, 1.
std::array<std::array<double, 3>, 3> lagrange(double t)
{
  return {{{0.5 * t * (t - 1), t - 0.5, 1}, {1 - t * t, -2 * t, -2}, {0.5 * t * (t + 1), t + 0.5, 1}}};
}

SurfaceShapes square_shapes(const Eigen::Vector2d &at)
{
  static constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  const auto xi = lagrange(at.x()), eta = lagrange(at.y());
  SurfaceShapes shapes(9, 6);
  for (int i = 0; i < 9; ++i)
  {
    const std::array<double, 3> &f = xi[column[i]], &g = eta[row[i]];
    shapes.row(i) << f[0] * g[0], f[1] * g[0], f[0] * g[1], f[2] * g[0], f[1] * g[1], f[0] * g[2];
  }
  return shapes;
}

SurfaceShapes triangle_shapes(const Eigen::Vector2d &at)
{
  const double x = at.x(), y = at.y(), z = 1 - x - y;
  SurfaceShapes shapes(6, 6);
  shapes << z * (2 * z - 1), 1 - 4 * z, 1 - 4 * z, 4, 4, 4, //
      x * (2 * x - 1), 4 * x - 1, 0, 4, 0, 0,               //
      y * (2 * y - 1), 0, 4 * y - 1, 0, 0, 4,               //
      4 * z * x, 4 * (z - x), -4 * x, -8, -4, 0,            //
      4 * x * y, 4 * y, 4 * x, 0, 4, 0,                     //
      4 * y * z, -4 * y, 4 * (z - y), 0, -4, -8;
  return shapes;
}

Eigen::Vector2d centre(int n_nodes)
{
  return n_nodes == 9 ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(1. / 3, 1. / 3);
}
} // namespace

SurfaceShapes surface_shapes(int n_nodes, const Eigen::Vector2d &at)
{
  return n_nodes == 9 ? square_shapes(at) : triangle_shapes(at);
}

FaceProjection project(const Eigen::Matrix3Xd &nodes, const Eigen::Vector3d &point, const Eigen::Vector2d &start)
{
  const int n = static_cast<int>(nodes.cols());
  const double reach = n == 9 ? 3 : 1.5; // reference coordinates from the centre
  FaceProjection found;
  found.at = start;
  for (int iteration = 0; iteration < 25 && (found.at - centre(n)).norm() < reach; ++iteration)
  {
    found.shapes = surface_shapes(n, found.at);
    const Eigen::Matrix<double, 3, 6> x = nodes * found.shapes;
    const Eigen::Vector3d r = point - x.col(0);
    found.tangents = x.middleCols<2>(1);
    found.metric = found.tangents.transpose() * found.tangents;
    Eigen::Matrix2d second;
    second << r.dot(x.col(3)), r.dot(x.col(4)), r.dot(x.col(4)), r.dot(x.col(5));
    Eigen::Matrix2d slope = found.metric - second;
    // Far from the face the distance is not convex: there a step of Gauss and Newton.
    if (!(slope.determinant() > 0 && slope(0, 0) > 0))
      slope = found.metric;
    const Eigen::Vector2d step = slope.inverse() * (found.tangents.transpose() * r);
    if (!(step.norm() > 1e-12))
    {
      found.normal = found.tangents.col(0).cross(found.tangents.col(1)).normalized();
      found.gap = found.normal.dot(r);
      const auto b = [&](int k) { return found.normal.dot(x.col(k)); };
      found.curvature << b(3), b(4), b(4), b(5);
      found.converged = std::isfinite(found.gap);
      return found;
    }
    found.at += step.norm() > 1 ? Eigen::Vector2d(step.normalized()) : step;
  }
  return found;
}

GapDerivatives gap_derivatives(const FaceProjection &p, const Eigen::VectorXd &own_shape)
{
  const Eigen::Index n_own = own_shape.size(), n = p.shapes.rows(), n_all = n_own + n;
  Eigen::VectorXd weights(n_all);
  weights << own_shape, -p.shapes.col(0);
  // Derivatives of the closest point's coordinates: A dxi = x,i . (weights dx) + g n . (N,i dx), A = a - g b.
  GapDerivatives d;
  d.gradient.resize(3 * n_all);
  Eigen::Matrix<double, Eigen::Dynamic, 2> tangential(3 * n_all, 2), bending = tangential;
  bending.setZero();
  for (Eigen::Index i = 0; i < n_all; ++i)
  {
    d.gradient.segment<3>(3 * i) = weights[i] * p.normal;
    tangential.middleRows<3>(3 * i) = weights[i] * p.tangents;
    if (i >= n_own)
      bending.middleRows<3>(3 * i) = p.normal * p.shapes.block<1, 2>(i - n_own, 1);
  }
  const Eigen::Matrix2d a = p.metric - p.gap * p.curvature, inverse_metric = p.metric.inverse();
  d.basis.resize(3 * n_all, 4);
  d.basis.leftCols<2>() = (tangential + p.gap * bending) * a.inverse();
  d.basis.rightCols<2>() = bending;
  // d2g = -(M P + P M + P b P) + g C a^-1 C with M = bending, P = dxi, C = M + b P.
  const Eigen::Matrix2d &b = p.curvature;
  const Eigen::Matrix2d mixed = p.gap * b * inverse_metric - Eigen::Matrix2d::Identity();
  d.coupling << p.gap * b * inverse_metric * b - b, mixed, mixed.transpose(), p.gap * inverse_metric;
  return d;
}
} // namespace pelvireg::reference_fe
