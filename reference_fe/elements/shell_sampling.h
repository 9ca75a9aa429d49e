// Base vectors of the 7-parameter shell and their derivatives at the strain sampling points of one cell.
#pragma once

#include "reference_fe/elements/shell_reference_cell.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pelvireg::reference_fe
{
/// Current nodal values of a cell, columns are nodes: r = R + u, d = N + w (3 x n), alpha and half thickness (n).
struct ShellNodalValues
{
  Eigen::Matrix3Xd r, d;
  Eigen::RowVectorXd alpha, half_thickness;
};

/// One covariant base vector g_i = dx/dxi_i at a set of points and its derivatives with respect to the unknowns.
struct BaseVector
{
  Eigen::Matrix3Xd g;               ///< 3 x n_points
  Eigen::MatrixXd p;                ///< 2n x n_points: dg_i = p du, p dw (times the identity), u first
  std::array<Eigen::MatrixXd, 3> v; ///< n x n_points each: component k of dg_i / dalpha
  Eigen::MatrixXd a;                ///< n x n_points: d2 g_i / dw_b dalpha_a = N_b a_a + N_b,i b_a
};

/// All base vectors at the points of one ShapeTable and one zeta; a direction that is not needed stays empty.
struct SampledBase
{
  std::array<BaseVector, 3> along;
  Eigen::MatrixXd b; ///< n x n_points
};

SampledBase sample_base(const ShellNodalValues &nodal, const ShapeTable &shape, double zeta,
                        const std::vector<int> &directions);

/// The assumed covariant metric (g_i . g_j / 2, engineering factors) at the integration points of all zeta.
struct AssumedStrains
{
  std::vector<SampledBase> bases; ///< zeta slowest, then the four samplings
  Eigen::MatrixXd metric;         ///< 6 x (n_zeta n_integration), zeta slowest
  Eigen::MatrixXd rows; ///< 7n x (6 n_zeta n_integration): derivative of component c at point q is column 6 q + c
};

AssumedStrains assume_strains(const ShellReferenceCell &reference, const ShellNodalValues &nodal);

/// Second derivatives of the assumed strains, contracted with the weighted stresses (6 x n_zeta n_integration,
/// covariant pairs), added to `tangent` (7n x 7n).
void add_geometric_stiffness(const ShellReferenceCell &reference, const AssumedStrains &assumed,
                             const Eigen::MatrixXd &weighted_stress, Eigen::MatrixXd &tangent);
} // namespace pelvireg::reference_fe
