#include "registration/solver/contact_sweeps.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::registration
{
namespace
{
constexpr double least_relative_diagonal = 1e-9;

struct Slip
{
  double first = 0, second = 0;
};

/// Nearest point of the disk.
Slip project(Slip force, double radius)
{
  const double length = std::hypot(force.first, force.second);
  if (!(length > radius))
    return force;
  return {force.first * radius / length, force.second * radius / length};
}
} // namespace

void ContactSweeps::reserve(std::size_t n_rows)
{
  motion_.reserve(n_rows);
  normal_stiffness_.reserve(n_rows);
  slip_stiffness_.reserve(n_rows);
}

void ContactSweeps::take_motion(const ContactProblem &problem, const double *multipliers)
{
  const int n = problem.n_rows, stride = problem.rows_per_contact;
  motion_.resize(n);
  for (int row = 0; row < n; ++row)
    motion_[row] = -problem.gaps[row];
  double mean = 0;
  for (int column = 0; column < n; ++column)
  {
    const double *entries = problem.matrix + static_cast<std::ptrdiff_t>(column) * n;
    mean += entries[column] / n;
    for (int row = 0; row < n; ++row)
      motion_[row] += entries[row] * multipliers[column];
  }
  normal_stiffness_.assign(n / stride, 0);
  slip_stiffness_.assign(n / stride, 0);
  const auto at = [&](int row, int column) { return problem.matrix[static_cast<std::ptrdiff_t>(column) * n + row]; };
  for (int contact = 0, row = 0; row < n; ++contact, row += stride)
  {
    if (at(row, row) > least_relative_diagonal * mean)
      normal_stiffness_[contact] = 1 / at(row, row);
    if (stride != 3)
      continue;
    const double a = at(row + 1, row + 1), b = at(row + 2, row + 2), c = at(row + 1, row + 2);
    const double largest = 0.5 * (a + b) + std::hypot(0.5 * (a - b), c);
    if (largest > least_relative_diagonal * mean)
      slip_stiffness_[contact] = 1 / largest;
  }
}

int ContactSweeps::solve(const ContactProblem &problem, const SweepLimits &limits, double *multipliers)
{
  const int n = problem.n_rows, stride = problem.rows_per_contact;
  for (int contact = 0, row = 0; row < n; ++contact, row += stride)
  {
    multipliers[row] = std::max(0.0, multipliers[row]);
    if (stride != 3)
      continue;
    const Slip inside =
        project({multipliers[row + 1], multipliers[row + 2]}, problem.friction_coefficient * multipliers[row]);
    multipliers[row + 1] = inside.first;
    multipliers[row + 2] = inside.second;
  }
  take_motion(problem, multipliers);
  double change_mm = 0, change_newton = 0;
  const auto set = [&](int row, double value, double stiffness)
  {
    const double change = value - multipliers[row];
    if (change == 0)
      return;
    const double *entries = problem.matrix + static_cast<std::ptrdiff_t>(row) * n;
    for (int other = 0; other < n; ++other)
      motion_[other] += entries[other] * change;
    multipliers[row] = value;
    change_newton = std::max(change_newton, std::abs(change));
    change_mm = std::max(change_mm, std::abs(change) / stiffness);
  };
  for (int sweep = 1; sweep <= limits.max_sweeps; ++sweep)
  {
    change_mm = change_newton = 0;
    for (int contact = 0, row = 0; row < n; ++contact, row += stride)
    {
      const double normal = normal_stiffness_[contact];
      if (!(normal > 0))
        continue;
      set(row, std::max(0.0, multipliers[row] - normal * motion_[row]), normal);
      const double slip = slip_stiffness_[contact];
      if (stride != 3 || !(slip > 0))
        continue;
      const Slip force =
          project({multipliers[row + 1] - slip * motion_[row + 1], multipliers[row + 2] - slip * motion_[row + 2]},
                  problem.friction_coefficient * multipliers[row]);
      set(row + 1, force.first, slip);
      set(row + 2, force.second, slip);
    }
    if (!(change_mm > limits.tolerance_mm) && !(change_newton > limits.tolerance_newton))
      return sweep;
  }
  return limits.max_sweeps;
}

ContactResidual ContactSweeps::residual(const ContactProblem &problem, const double *multipliers)
{
  take_motion(problem, multipliers);
  ContactResidual worst;
  const auto meet = [&](double force, double stiffness)
  {
    worst.force = std::max(worst.force, force);
    worst.motion = std::max(worst.motion, force / stiffness);
  };
  const int stride = problem.rows_per_contact;
  for (int contact = 0, row = 0; row < problem.n_rows; ++contact, row += stride)
  {
    const double normal = normal_stiffness_[contact], slip = slip_stiffness_[contact];
    if (!(normal > 0))
      continue;
    const double pressing = multipliers[row];
    worst.complementarity = std::max(worst.complementarity, std::abs(pressing * motion_[row]));
    meet(std::abs(pressing - std::max(0.0, pressing - normal * motion_[row])), normal);
    if (stride != 3 || !(slip > 0))
      continue;
    const double radius = problem.friction_coefficient * pressing;
    const Slip held{multipliers[row + 1], multipliers[row + 2]};
    const Slip image = project({held.first - slip * motion_[row + 1], held.second - slip * motion_[row + 2]}, radius);
    meet(std::hypot(held.first - image.first, held.second - image.second), slip);
    worst.cone_violation = std::max(worst.cone_violation, std::hypot(held.first, held.second) - radius);
  }
  return worst;
}
} // namespace pelvireg::registration
