// Shape functions, quadrature and strain sampling points of the 7-parameter shell on the unit square.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pelvireg::reference_fe
{
/// Lagrange shape functions of order p (nodes in the order of deal.II's FE_Q(p)) at a set of points.
struct ShapeTable
{
  Eigen::MatrixXd value; ///< n_nodes x n_points
  Eigen::MatrixXd d1;    ///< derivative along the first coordinate
  Eigen::MatrixXd d2;    ///< derivative along the second
  int n_points() const { return static_cast<int>(value.cols()); }
};

/// One strain component taken at the sampling points: covariant pair (i, j) and its Voigt index.
struct SampledComponent
{
  int voigt = 0;
  int i = 0, j = 0; ///< 0, 1: in the surface; 2: through the thickness
};

/// Points at which some covariant strain components are sampled, and how they are carried to the integration points.
struct StrainSampling
{
  ShapeTable shape;
  Eigen::MatrixXd interpolation; ///< n_integration x n_points
  std::vector<SampledComponent> components;
  std::vector<int> directions; ///< base vectors that the components need
};

/// Assumed strains (MITC9-like): E11, E13 from Gauss(p) points along coordinate 1; E22, E23 along coordinate 2;
/// E12 from Gauss(p) x Gauss(p); E33 from the nodes, which removes curvature-thickness locking. Bucalem and Bathe,
/// Int. J. Numer. Meth. Eng. 36 (1993) 3729; Betsch and Stein, Comm. Numer. Meth. Eng. 11 (1995) 899.
struct ShellReferenceCell
{
  int order = 2;
  int n_nodes = 9;
  ShapeTable integration; ///< Gauss(p + 1) x Gauss(p + 1)
  Eigen::VectorXd weight; ///< of the integration points; sum 1
  std::array<StrainSampling, 4> samplings;
  /// Two Gauss points through the thickness. A third would lock a nearly incompressible thick wall: a quadratic
  /// displacement through the thickness cannot keep the volume at three points (a sphere of thickness/radius 0.3 and
  /// kappa/mu 1000 would be 38 % too stiff), but at two it can; energies quadratic in zeta are integrated exactly.
  static constexpr int n_zeta = 2;
  Eigen::Vector2d zeta;        ///< in [-1, 1]
  Eigen::Vector2d zeta_weight; ///< sum 2

  /// order: 1, 2 or 3.
  explicit ShellReferenceCell(int order);
};

/// Shape functions of order p at points of the unit square (2 x n).
ShapeTable shape_table(int order, const Eigen::Matrix2Xd &points);
} // namespace pelvireg::reference_fe
