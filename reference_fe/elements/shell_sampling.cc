#include "reference_fe/elements/shell_sampling.h"

namespace pelvireg::reference_fe
{
namespace
{
/// Component (i, j) of the metric at the sampling points, and its derivatives (7n x n_points).
void sample_component(const SampledBase &base, const SampledComponent &component, Eigen::RowVectorXd &metric,
                      Eigen::MatrixXd &rows)
{
  const BaseVector &first = base.along[component.i], &second = base.along[component.j];
  const bool shear = component.i != component.j;
  metric = (shear ? 1.0 : 0.5) * first.g.cwiseProduct(second.g).colwise().sum();
  const Eigen::Index n = base.b.rows(), n_points = first.g.cols();
  rows.resize(7 * n, n_points);
  for (Eigen::Index t = 0; t < n_points; ++t)
    for (Eigen::Index m = 0; m < 2 * n; ++m)
      rows.col(t).segment<3>(3 * m) = first.p(m, t) * second.g.col(t);
  auto stretch_rows = rows.bottomRows(n);
  stretch_rows.setZero();
  for (int k = 0; k < 3; ++k)
    stretch_rows += first.v[k] * second.g.row(k).asDiagonal();
  if (!shear)
    return;
  for (Eigen::Index t = 0; t < n_points; ++t)
    for (Eigen::Index m = 0; m < 2 * n; ++m)
      rows.col(t).segment<3>(3 * m) += second.p(m, t) * first.g.col(t);
  for (int k = 0; k < 3; ++k)
    stretch_rows += second.v[k] * first.g.row(k).asDiagonal();
}

/// Columns that multiply to the geometric stiffness, collected over all samplings.
struct GeometricColumns
{
  Eigen::MatrixXd p, stressed_p;                    ///< 2n x m
  std::array<Eigen::MatrixXd, 3> v, stressed_v;     ///< n x m
  std::array<Eigen::MatrixXd, 3> director, stretch; ///< n x 2m
};

Eigen::Index count_columns(const ShellReferenceCell &reference)
{
  Eigen::Index m = 0;
  for (const StrainSampling &sampling : reference.samplings)
    m += reference.n_zeta * static_cast<Eigen::Index>(sampling.directions.size()) * sampling.shape.n_points();
  return m;
}

/// Add the columns of one sampling at one zeta; `stress` holds one row a component, n_points columns.
void collect(const StrainSampling &sampling, const SampledBase &base, const Eigen::MatrixXd &stress,
             GeometricColumns &columns, Eigen::Index &m)
{
  const Eigen::Index n_points = sampling.shape.n_points(), total = columns.p.cols();
  for (const int i : sampling.directions)
  {
    const BaseVector &own = base.along[i];
    columns.p.middleCols(m, n_points) = own.p;
    for (int k = 0; k < 3; ++k)
      columns.v[k].middleCols(m, n_points) = own.v[k];
    Eigen::Matrix3Xd traction = Eigen::Matrix3Xd::Zero(3, n_points);
    for (std::size_t c = 0; c < sampling.components.size(); ++c)
    {
      const SampledComponent &component = sampling.components[c];
      if (component.i != i && component.j != i)
        continue;
      const BaseVector &other = base.along[component.i == i ? component.j : component.i];
      const auto s = stress.row(c).asDiagonal();
      columns.stressed_p.middleCols(m, n_points) += other.p * s;
      for (int k = 0; k < 3; ++k)
        columns.stressed_v[k].middleCols(m, n_points) += other.v[k] * s;
      traction += other.g * s;
    }
    for (int k = 0; k < 3; ++k)
    {
      columns.director[k].middleCols(m, n_points) = sampling.shape.value * traction.row(k).asDiagonal();
      columns.stretch[k].middleCols(m, n_points) = own.a;
      if (i == 2)
        continue;
      const Eigen::MatrixXd &slope = i == 0 ? sampling.shape.d1 : sampling.shape.d2;
      columns.director[k].middleCols(total + m, n_points) = slope * traction.row(k).asDiagonal();
      columns.stretch[k].middleCols(total + m, n_points) = base.b;
    }
    m += n_points;
  }
}

GeometricColumns collect_columns(const ShellReferenceCell &reference, const AssumedStrains &assumed,
                                 const Eigen::MatrixXd &weighted_stress)
{
  const Eigen::Index n = reference.n_nodes, total = count_columns(reference);
  const Eigen::Index n_integration = reference.weight.size();
  GeometricColumns columns;
  columns.p.resize(2 * n, total);
  columns.stressed_p.setZero(2 * n, total);
  for (int k = 0; k < 3; ++k)
  {
    columns.v[k].resize(n, total);
    columns.stressed_v[k].setZero(n, total);
    columns.director[k].setZero(n, 2 * total);
    columns.stretch[k].setZero(n, 2 * total);
  }
  Eigen::Index m = 0;
  for (int z = 0; z < reference.n_zeta; ++z)
    for (std::size_t k = 0; k < reference.samplings.size(); ++k)
    {
      const StrainSampling &sampling = reference.samplings[k];
      Eigen::MatrixXd stress(sampling.components.size(), sampling.shape.n_points());
      for (std::size_t c = 0; c < sampling.components.size(); ++c)
        stress.row(c).noalias() =
            weighted_stress.row(sampling.components[c].voigt).segment(z * n_integration, n_integration) *
            sampling.interpolation;
      collect(sampling, assumed.bases[z * reference.samplings.size() + k], stress, columns, m);
    }
  return columns;
}
} // namespace

SampledBase sample_base(const ShellNodalValues &nodal, const ShapeTable &shape, double zeta,
                        const std::vector<int> &directions)
{
  const Eigen::RowVectorXd alpha = nodal.alpha * shape.value, h = nodal.half_thickness * shape.value;
  const Eigen::Matrix3Xd d = nodal.d * shape.value;
  const double square = zeta * zeta;
  const Eigen::RowVectorXd fibre = h.array() * (zeta + square * alpha.array());
  const Eigen::Index n = shape.value.rows(), n_points = shape.n_points();

  SampledBase base;
  base.b = square * shape.value * h.asDiagonal();
  for (const int i : directions)
  {
    BaseVector &own = base.along[i];
    own.p.setZero(2 * n, n_points);
    if (i == 2)
    {
      const Eigen::RowVectorXd fibre_3 = h.array() * (1 + 2 * zeta * alpha.array());
      own.g = d * fibre_3.asDiagonal();
      own.p.bottomRows(n) = shape.value * fibre_3.asDiagonal();
      own.a = 2 * zeta * shape.value * h.asDiagonal();
      for (int k = 0; k < 3; ++k)
        own.v[k] = own.a * d.row(k).asDiagonal();
      continue;
    }
    const Eigen::MatrixXd &slope = i == 0 ? shape.d1 : shape.d2;
    const Eigen::RowVectorXd h_i = nodal.half_thickness * slope, alpha_i = nodal.alpha * slope;
    const Eigen::RowVectorXd fibre_i =
        h_i.array() * (zeta + square * alpha.array()) + square * h.array() * alpha_i.array();
    const Eigen::Matrix3Xd d_i = nodal.d * slope;
    own.g = nodal.r * slope + d * fibre_i.asDiagonal() + d_i * fibre.asDiagonal();
    own.p.topRows(n) = slope;
    own.p.bottomRows(n) = shape.value * fibre_i.asDiagonal() + slope * fibre.asDiagonal();
    own.a = square * (shape.value * h_i.asDiagonal() + slope * h.asDiagonal());
    for (int k = 0; k < 3; ++k)
      own.v[k] = own.a * d.row(k).asDiagonal() + base.b * d_i.row(k).asDiagonal();
  }
  return base;
}

AssumedStrains assume_strains(const ShellReferenceCell &reference, const ShellNodalValues &nodal)
{
  const Eigen::Index n_integration = reference.weight.size(), n_unknowns = 7 * reference.n_nodes;
  AssumedStrains assumed;
  assumed.metric.resize(6, reference.n_zeta * n_integration);
  assumed.rows.resize(n_unknowns, 6 * reference.n_zeta * n_integration);
  Eigen::RowVectorXd metric;
  Eigen::MatrixXd rows;
  for (int z = 0; z < reference.n_zeta; ++z)
    for (const StrainSampling &sampling : reference.samplings)
    {
      assumed.bases.push_back(sample_base(nodal, sampling.shape, reference.zeta[z], sampling.directions));
      for (const SampledComponent &component : sampling.components)
      {
        sample_component(assumed.bases.back(), component, metric, rows);
        assumed.metric.row(component.voigt).segment(z * n_integration, n_integration).noalias() =
            metric * sampling.interpolation.transpose();
        Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> target(
            assumed.rows.data() + (6 * z * n_integration + component.voigt) * n_unknowns, n_unknowns, n_integration,
            Eigen::OuterStride<>(6 * n_unknowns));
        target.noalias() = rows * sampling.interpolation.transpose();
      }
    }
  return assumed;
}

void add_geometric_stiffness(const ShellReferenceCell &reference, const AssumedStrains &assumed,
                             const Eigen::MatrixXd &weighted_stress, Eigen::MatrixXd &tangent)
{
  const Eigen::Index n = reference.n_nodes;
  const GeometricColumns columns = collect_columns(reference, assumed, weighted_stress);

  const Eigen::MatrixXd scalar = columns.p * columns.stressed_p.transpose();
  for (Eigen::Index b = 0; b < 2 * n; ++b)
    for (Eigen::Index a = 0; a < 2 * n; ++a)
      for (int k = 0; k < 3; ++k)
        tangent(3 * a + k, 3 * b + k) += scalar(a, b);

  for (int k = 0; k < 3; ++k)
  {
    Eigen::MatrixXd mixed = columns.stressed_p * columns.v[k].transpose(); // 2n x n
    mixed.bottomRows(n).noalias() += columns.director[k] * columns.stretch[k].transpose();
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index a = 0; a < 2 * n; ++a)
      {
        tangent(3 * a + k, 6 * n + b) += mixed(a, b);
        tangent(6 * n + b, 3 * a + k) += mixed(a, b);
      }
    tangent.bottomRightCorner(n, n).noalias() += columns.v[k] * columns.stressed_v[k].transpose();
  }
}
} // namespace pelvireg::reference_fe
