#include "reference_fe/elements/shell_cell.h"

#include "reference_fe/elements/shell_sampling.h"
#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pelvireg::reference_fe
{
namespace
{
/// Voigt matrix that takes covariant strains to a Cartesian frame; columns of `contravariant` are G^i.
VoigtMatrix covariant_to_cartesian(const Eigen::Matrix3d &contravariant)
{
  static constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  VoigtMatrix transform;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c)
    {
      const int m = first[r], n = second[r], i = first[c], j = second[c];
      const double product =
          0.5 * (contravariant(m, i) * contravariant(n, j) + contravariant(n, i) * contravariant(m, j));
      transform(r, c) = (m == n ? 1 : 2) * product;
    }
  return transform;
}

ShellNodalValues nodal_values(const Eigen::Matrix3Xd &midsurface, const Eigen::Matrix3Xd &director,
                              const Eigen::VectorXd &half_thickness, const Eigen::VectorXd &q)
{
  const Eigen::Index n = midsurface.cols();
  ShellNodalValues nodal;
  nodal.r = midsurface + Eigen::Map<const Eigen::Matrix3Xd>(q.data(), 3, n);
  nodal.d = director + Eigen::Map<const Eigen::Matrix3Xd>(q.data() + 3 * n, 3, n);
  nodal.alpha = q.tail(n).transpose();
  nodal.half_thickness = half_thickness.transpose();
  return nodal;
}

Eigen::Matrix3d base_matrix(const SampledBase &base, Eigen::Index point)
{
  Eigen::Matrix3d g;
  for (int i = 0; i < 3; ++i)
    g.col(i) = base.along[i].g.col(point);
  return g;
}

const std::vector<int> all_directions = {0, 1, 2};
} // namespace

ShellCell::ShellCell(const ShellReferenceCell &reference, Eigen::Matrix3Xd midsurface, Eigen::Matrix3Xd director,
                     Eigen::VectorXd half_thickness)
    : reference_(&reference), midsurface_(std::move(midsurface)), director_(std::move(director)),
      half_thickness_(std::move(half_thickness))
{
  set_integration_points();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7 * reference.n_nodes);
  rest_metric_ = assume_strains(reference, nodal_values(midsurface_, director_, half_thickness_, rest)).metric;
}

void ShellCell::set_integration_points()
{
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7 * reference_->n_nodes);
  const ShellNodalValues nodal = nodal_values(midsurface_, director_, half_thickness_, rest);
  for (int z = 0; z < reference_->n_zeta; ++z)
  {
    const SampledBase base = sample_base(nodal, reference_->integration, reference_->zeta[z], all_directions);
    for (Eigen::Index q = 0; q < reference_->weight.size(); ++q)
    {
      const Eigen::Matrix3d covariant = base_matrix(base, q);
      const double jacobian = covariant.determinant();
      if (!(jacobian > 0))
        throw InputError(
            fmt::format("a shell cell near ({:.2f}, {:.2f}, {:.2f}) mm has the volume element {:.3g} mm^3; "
                        "it must be positive: is the wall thicker than the radius, or the cell turned?",
                        midsurface_(0, 0), midsurface_(1, 0), midsurface_(2, 0), jacobian));
      points_.push_back({covariant_to_cartesian(covariant.inverse().transpose()),
                         jacobian * reference_->weight[q] * reference_->zeta_weight[z]});
    }
  }
}

Eigen::MatrixXd ShellCell::stress(const HyperelasticLaw &law, const Eigen::MatrixXd &strain,
                                  const Eigen::MatrixXd &rows, Eigen::MatrixXd *tangent_rows, double &energy) const
{
  Eigen::MatrixXd weighted(6, points_.size());
  energy = 0;
  for (std::size_t q = 0; q < points_.size(); ++q)
  {
    const IntegrationPoint &point = points_[q];
    const StressState state = law.evaluate(point.to_cartesian * strain.col(q));
    energy += point.weight * state.energy;
    weighted.col(q) = point.weight * (point.to_cartesian.transpose() * state.stress);
    if (!tangent_rows)
      continue;
    const VoigtMatrix moduli = point.weight * (point.to_cartesian.transpose() * (state.tangent * point.to_cartesian));
    tangent_rows->middleCols<6>(6 * q).noalias() = rows.middleCols<6>(6 * q) * moduli;
  }
  return weighted;
}

Eigen::MatrixXd ShellCell::extrapolated_stress(const HyperelasticLaw &law, const Eigen::VectorXd &previous,
                                               const Eigen::VectorXd &q) const
{
  const AssumedStrains assumed =
      assume_strains(*reference_, nodal_values(midsurface_, director_, half_thickness_, previous));
  const Eigen::VectorXd increment = assumed.rows.transpose() * (q - previous);
  Eigen::MatrixXd weighted(6, points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k)
  {
    const IntegrationPoint &point = points_[k];
    const StressState state = law.evaluate(point.to_cartesian * (assumed.metric.col(k) - rest_metric_.col(k)));
    const Voigt extrapolated = state.stress + state.tangent * (point.to_cartesian * increment.segment<6>(6 * k));
    weighted.col(k) = point.weight * (point.to_cartesian.transpose() * extrapolated);
  }
  return weighted;
}

void ShellCell::evaluate(const HyperelasticLaw &law, const Eigen::VectorXd &q, const Eigen::VectorXd *previous,
                         LocalSystem &local) const
{
  const AssumedStrains assumed = assume_strains(*reference_, nodal_values(midsurface_, director_, half_thickness_, q));
  Eigen::MatrixXd tangent_rows;
  if (local.with_tangent)
    tangent_rows.resize(assumed.rows.rows(), assumed.rows.cols());
  const Eigen::MatrixXd weighted_stress = stress(law, assumed.metric - rest_metric_, assumed.rows,
                                                 local.with_tangent ? &tangent_rows : nullptr, local.energy);
  local.residual.noalias() =
      assumed.rows * Eigen::Map<const Eigen::VectorXd>(weighted_stress.data(), weighted_stress.size());
  if (!local.with_tangent)
    return;
  local.tangent.noalias() = tangent_rows * assumed.rows.transpose();
  add_geometric_stiffness(*reference_, assumed, previous ? extrapolated_stress(law, *previous, q) : weighted_stress,
                          local.tangent);
}

double ShellCell::volume() const
{
  double volume = 0;
  for (const IntegrationPoint &point : points_)
    volume += point.weight;
  return volume;
}

double ShellCell::smallest_jacobian(const Eigen::VectorXd &q) const
{
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.size());
  const ShellNodalValues before = nodal_values(midsurface_, director_, half_thickness_, rest);
  const ShellNodalValues now = nodal_values(midsurface_, director_, half_thickness_, q);
  double smallest = std::numeric_limits<double>::infinity();
  for (const double zeta : {-1.0, 0.0, 1.0})
  {
    const SampledBase base = sample_base(before, reference_->integration, zeta, all_directions);
    const SampledBase moved = sample_base(now, reference_->integration, zeta, all_directions);
    for (Eigen::Index point = 0; point < reference_->weight.size(); ++point)
      smallest = std::min(smallest, base_matrix(moved, point).determinant() / base_matrix(base, point).determinant());
  }
  return smallest;
}
} // namespace pelvireg::reference_fe
