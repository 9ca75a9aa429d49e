#include "tests/verification/reference_fe/shell/beams.h"

#include <Eigen/Dense>

#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
/// One step of the Runge-Kutta method of order 4 for an autonomous system.
template <typename State, typename Rate> State runge_kutta(const State &y, double h, const Rate &rate)
{
  const State k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
  return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/// (r, r', moment) at the upper face of a strip whose lower face lies at the radius `lower`, and r of the middle.
Eigen::Vector4d across_strip(double lower, double curvature, double thickness, double youngs_modulus)
{
  const double k2 = curvature * curvature;
  const auto rate = [&](const Eigen::Vector3d &y)
  {
    const double e11 = 0.5 * (k2 * y[0] * y[0] - 1);
    return Eigen::Vector3d(y[1], 2 * k2 * y[0] * e11 / (3 * y[1] * y[1] - 1),
                           youngs_modulus * e11 * curvature * y[0] * y[0]);
  };
  const int n = 64; // even
  Eigen::Vector3d y(lower, 1, 0);
  double middle = 0;
  for (int i = 0; i < n; ++i)
  {
    if (i == n / 2)
      middle = y[0];
    y = runge_kutta(y, thickness / n, rate);
  }
  return {y[0], y[1], y[2], middle};
}
} // namespace

TipDisplacement elastica(double load, double length, double bending_stiffness)
{
  const int n = 400;
  const auto rate = [&](const Eigen::Vector4d &y) // theta, theta', x, z
  { return Eigen::Vector4d(y[1], -load / bending_stiffness * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])); };
  const auto shoot = [&](double curvature)
  {
    Eigen::Vector4d y(0, curvature, 0, 0);
    for (int i = 0; i < n; ++i)
      y = runge_kutta(y, length / n, rate);
    return y;
  };
  double low = 0, high = load * length / bending_stiffness;
  for (int i = 0; i < 60; ++i)
    (shoot(0.5 * (low + high))[1] > 0 ? high : low) = 0.5 * (low + high);
  const Eigen::Vector4d tip = shoot(low);
  return {length - tip[2], tip[3]};
}

TipDisplacement straight_beams(double load, double length, double bending_stiffness, int n)
{
  const double piece = length / n, stiffness = bending_stiffness / piece;
  Eigen::VectorXd angle = Eigen::VectorXd::Zero(n + 1); // of the nodes; the first is clamped
  for (int iteration = 0; iteration < 60; ++iteration)
  {
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(n + 1);
    Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(n + 1, n + 1);
    for (int i = 0; i < n; ++i)
    {
      const double middle = 0.5 * (angle[i] + angle[i + 1]), bend = stiffness * (angle[i + 1] - angle[i]);
      const double turn = 0.5 * load * piece * std::cos(middle), soften = 0.25 * load * piece * std::sin(middle);
      residual.segment<2>(i) += Eigen::Vector2d(-bend - turn, bend - turn);
      tangent.block<2, 2>(i, i) +=
          (Eigen::Matrix2d() << stiffness + soften, soften - stiffness, soften - stiffness, stiffness + soften)
              .finished();
    }
    const Eigen::VectorXd step = tangent.bottomRightCorner(n, n).ldlt().solve(residual.tail(n));
    angle.tail(n) -= step;
    if (step.lpNorm<Eigen::Infinity>() < 1e-14)
      break;
  }
  TipDisplacement tip(length, 0);
  for (int i = 0; i < n; ++i)
  {
    const double middle = 0.5 * (angle[i] + angle[i + 1]);
    tip += piece * Eigen::Vector2d(-std::cos(middle), std::sin(middle));
  }
  return tip;
}

TipDisplacement rolled_up(double angle, double length)
{
  return {length * (1 - std::sin(angle) / angle), length * (1 - std::cos(angle)) / angle};
}

RolledStrip rolled_strip(double curvature, double thickness, double youngs_modulus)
{
  double low = 0.9 * (1 / curvature - 0.5 * thickness), high = 1 / curvature;
  for (int i = 0; i < 80; ++i)
  {
    const double lower = 0.5 * (low + high);
    (across_strip(lower, curvature, thickness, youngs_modulus)[1] > 1 ? high : low) = lower;
  }
  const Eigen::Vector4d strip = across_strip(low, curvature, thickness, youngs_modulus);
  return {strip[2], strip[3]};
}

TipDisplacement rolled_strip_tip(double moment, double length, double thickness, double youngs_modulus)
{
  const double linear = moment / (youngs_modulus * std::pow(thickness, 3) / 12);
  double low = 0.9 * linear, high = 1.1 * linear;
  for (int i = 0; i < 60; ++i)
  {
    const double curvature = 0.5 * (low + high);
    (rolled_strip(curvature, thickness, youngs_modulus).moment > moment ? high : low) = curvature;
  }
  const double radius = rolled_strip(low, thickness, youngs_modulus).radius, angle = low * length;
  return {length - radius * std::sin(angle), radius * (1 - std::cos(angle))};
}
} // namespace pelvireg::reference_fe
