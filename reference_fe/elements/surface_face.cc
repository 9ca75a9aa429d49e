#include "reference_fe/elements/surface_face.h"

#include <array>
#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
/// Values and derivatives of the Lagrange polynomials at -1, 0, 1.
std::array<std::array<double, 2>, 3> lagrange(double t)
{
  return {{{0.5 * t * (t - 1), t - 0.5}, {1 - t * t, -2 * t}, {0.5 * t * (t + 1), t + 0.5}}};
}

FacePoint quadrilateral_shape(double xi, double eta)
{
  static constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  const auto in_xi = lagrange(xi), in_eta = lagrange(eta);
  FacePoint point{Eigen::VectorXd(9), Eigen::VectorXd(9), Eigen::VectorXd(9), 0};
  for (int i = 0; i < 9; ++i)
  {
    point.value[i] = in_xi[column[i]][0] * in_eta[row[i]][0];
    point.d_xi[i] = in_xi[column[i]][1] * in_eta[row[i]][0];
    point.d_eta[i] = in_xi[column[i]][0] * in_eta[row[i]][1];
  }
  return point;
}

FacePoint triangle_shape(double xi, double eta)
{
  const double z = 1 - xi - eta;
  FacePoint point{Eigen::VectorXd(6), Eigen::VectorXd(6), Eigen::VectorXd(6), 0};
  point.value << z * (2 * z - 1), xi * (2 * xi - 1), eta * (2 * eta - 1), 4 * z * xi, 4 * xi * eta, 4 * eta * z;
  point.d_xi << 1 - 4 * z, 4 * xi - 1, 0, 4 * (z - xi), 4 * eta, -4 * eta;
  point.d_eta << 1 - 4 * z, 0, 4 * eta - 1, -4 * xi, 4 * xi, 4 * (z - eta);
  return point;
}

std::vector<FacePoint> square_points()
{
  const std::array<double, 3> at = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight = {5. / 9, 8. / 9, 5. / 9};
  std::vector<FacePoint> points;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
    {
      points.push_back(quadrilateral_shape(at[i], at[j]));
      points.back().weight = weight[i] * weight[j];
    }
  return points;
}

std::vector<FacePoint> triangle_points()
{
  // Radon's rule of degree 5 on the unit triangle (area 1/2).
  const double s = std::sqrt(15.), a = (6 - s) / 21, b = (6 + s) / 21;
  const double weight_a = (155 - s) / 2400, weight_b = (155 + s) / 2400;
  std::vector<FacePoint> points;
  const auto add = [&](double xi, double eta, double weight) {
    points.push_back(triangle_shape(xi, eta));
    points.back().weight = weight;
  };
  add(1. / 3, 1. / 3, 9. / 80);
  for (const auto &[c, weight] : {std::pair{a, weight_a}, std::pair{b, weight_b}})
  {
    add(c, c, weight);
    add(1 - 2 * c, c, weight);
    add(c, 1 - 2 * c, weight);
  }
  return points;
}
/// x . (x,t cross x,s) = t c . (e cross e') for the cone c + t (e - c): degree 3 in s, and int t dt = 1/2.
std::vector<FacePoint> cap_points()
{
  std::vector<FacePoint> points;
  for (const double s : {-std::sqrt(1. / 3), std::sqrt(1. / 3)})
  {
    const auto edge = lagrange(s);
    FacePoint point{Eigen::VectorXd::Unit(4, 0), Eigen::VectorXd::Zero(4), Eigen::VectorXd::Zero(4), 0.5};
    for (int i = 0; i < 3; ++i)
    {
      point.d_xi[1 + i] = edge[i][0];
      point.d_eta[1 + i] = edge[i][1];
    }
    points.push_back(point);
  }
  return points;
}
} // namespace

FacePoint face_shape(int n_nodes, double xi, double eta)
{
  return n_nodes == 9 ? quadrilateral_shape(xi, eta) : triangle_shape(xi, eta);
}

const std::vector<FacePoint> &face_quadrature(int n_nodes)
{
  static const std::vector<FacePoint> square = square_points(), triangle = triangle_points(), cap = cap_points();
  return n_nodes == 9 ? square : n_nodes == 6 ? triangle : cap;
}

Eigen::Matrix3d skew(const Eigen::Vector3d &a)
{
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}
} // namespace pelvireg::reference_fe
