// Projected Gauss-Seidel on contacts with Coulomb friction.
#pragma once

#include <cstddef>
#include <vector>

namespace pelvireg::registration
{
/// Contacts of one step after everything bilateral has been eliminated: a motion r = S lambda - gap is left in every
/// row. Row 0 of a contact is normal: lambda_n >= 0, r_n >= 0 (mm of separation), one of them zero. Rows 1 and 2, with
/// friction, lie along the surface: |lambda_t| <= mu lambda_n, and where the surfaces slip (r_t != 0) it is reached and
/// opposes r_t.
struct ContactProblem
{
  int n_rows = 0;
  int rows_per_contact = 1; ///< 1 or, with friction, 3
  double friction_coefficient = 0;
  const double *matrix = nullptr; ///< S, n_rows x n_rows, both triangles, mm/N
  const double *gaps = nullptr;   ///< mm
};

/// How well a set of contact forces fulfils the laws of contact and friction. Residuals are those of the natural map
/// lambda - P(lambda - rho r) with P the projection on the cone's section and 1 / rho the row's own stiffness: zero at
/// a solution (Acary & Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008, 12.5).
struct ContactResidual
{
  double motion = 0;          ///< mm, largest of the natural map times 1 / rho
  double force = 0;           ///< N, largest of the natural map
  double complementarity = 0; ///< N mm, largest |lambda_n r_n|
  double cone_violation = 0;  ///< N, largest excess of |lambda_t| over mu lambda_n
};

struct SweepLimits
{
  double tolerance_mm = 1e-6;     ///< stop when no row's motion changes by more in a sweep …
  double tolerance_newton = 1e-4; ///< … and no force
  int max_sweeps = 500;
};

/// Sweeps in the order of the rows, so the result does not depend on anything else. Rows that nothing can move (a
/// diagonal below 1e-9 of the mean) keep zero force.
class ContactSweeps
{
public:
  /// Set memory aside.
  void reserve(std::size_t n_rows);

  /// `multipliers` (n_rows): in, the forces to start from; out, the solution or the last iterate. Number of sweeps.
  int solve(const ContactProblem &problem, const SweepLimits &limits, double *multipliers);

  ContactResidual residual(const ContactProblem &problem, const double *multipliers);

private:
  void take_motion(const ContactProblem &problem, const double *multipliers);

  std::vector<double> motion_;           ///< r, mm
  std::vector<double> normal_stiffness_; ///< 1 / S_nn of a contact, N/mm; 0: cannot be moved
  std::vector<double> slip_stiffness_;   ///< 1 / largest eigenvalue of S_tt, N/mm
};
} // namespace pelvireg::registration
