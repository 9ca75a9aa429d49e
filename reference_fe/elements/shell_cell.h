// One cell of the 7-parameter shell: strain, stress, residual and exact tangent.
#pragma once

#include "reference_fe/elements/shell_reference_cell.h"
#include "reference_fe/materials/hyperelastic_law.h"
#include "reference_fe/term.h"

#include <Eigen/StdVector>

#include <vector>

namespace pelvireg::reference_fe
{
/// x(xi, zeta) = r + H (zeta + alpha zeta^2) d with r = R + u, d = N + w and H half the thickness. Total Lagrangian,
/// the full three-dimensional law, no plane stress. Local unknowns: u of all nodes (3 each), w of all nodes, alpha of
/// all.
class ShellCell
{
public:
  /// Rest geometry at the nodes: mid-surface R and unit director N (3 x n_nodes, mm), half thickness (n_nodes, mm).
  /// Throws InputError when the volume element is not positive at an integration point.
  ShellCell(const ShellReferenceCell &reference, Eigen::Matrix3Xd midsurface, Eigen::Matrix3Xd director,
            Eigen::VectorXd half_thickness);

  /// Residual, tangent and energy at `q` (7 n_nodes). With `previous` (the last iterate, or null) the geometric
  /// stiffness uses the stress extrapolated from there (mixed integration points: Magisano, Leonetti and Garcea,
  /// Int. J. Numer. Meth. Eng. 109 (2017) 1237); the residual is not touched.
  void evaluate(const HyperelasticLaw &law, const Eigen::VectorXd &q, const Eigen::VectorXd *previous,
                LocalSystem &local) const;

  double volume() const; ///< at rest, mm^3
  /// Smallest det(dx/dX) over the integration points of the surface at zeta = -1, 0, 1: positive as long as nothing
  /// folds.
  double smallest_jacobian(const Eigen::VectorXd &q) const;

private:
  struct IntegrationPoint
  {
    VoigtMatrix to_cartesian; ///< E_cartesian = to_cartesian * E_covariant
    double weight = 0;        ///< mm^3
  };

  void set_integration_points();
  Eigen::MatrixXd stress(const HyperelasticLaw &law, const Eigen::MatrixXd &strain, const Eigen::MatrixXd &rows,
                         Eigen::MatrixXd *tangent_rows, double &energy) const;
  Eigen::MatrixXd extrapolated_stress(const HyperelasticLaw &law, const Eigen::VectorXd &previous,
                                      const Eigen::VectorXd &q) const;

  const ShellReferenceCell *reference_;
  Eigen::Matrix3Xd midsurface_, director_;
  Eigen::VectorXd half_thickness_;
  Eigen::MatrixXd rest_metric_; ///< 6 x (n_zeta n_integration), covariant, as the strains are assumed
  std::vector<IntegrationPoint, Eigen::aligned_allocator<IntegrationPoint>> points_; ///< zeta slowest
};
} // namespace pelvireg::reference_fe
