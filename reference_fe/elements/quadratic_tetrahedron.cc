#include "reference_fe/elements/quadratic_tetrahedron.h"

#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

namespace pelvireg::reference_fe
{
namespace
{
using Vector30 = Eigen::Matrix<double, 30, 1>;
using Matrix30 = Eigen::Matrix<double, 30, 30>;
using ShapeGradient = Eigen::Matrix<double, 10, 3>;

/// Derivatives of the shape functions in barycentric coordinates b1, b2, b3 (b0 = 1 - b1 - b2 - b3).
ShapeGradient shape_gradient(const Eigen::Vector4d &b)
{
  Eigen::Matrix<double, 4, 3> d; // of the barycentric coordinates
  d << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  static constexpr int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  ShapeGradient gradient;
  for (int i = 0; i < 4; ++i)
    gradient.row(i) = (4 * b[i] - 1) * d.row(i);
  for (int e = 0; e < 6; ++e)
    gradient.row(4 + e) = 4 * (b[edge[e][0]] * d.row(edge[e][1]) + b[edge[e][1]] * d.row(edge[e][0]));
  return gradient;
}

/// The determinant of dx/db (six times the volume element); throws InputError unless positive.
double positive_jacobian(const Eigen::Matrix3d &jacobian, const std::string &solid, Eigen::Index cell)
{
  const double det = jacobian.determinant();
  if (!(det > 0))
    throw InputError(fmt::format("solid '{}': tetrahedron {} is inverted or folded (Jacobian {:.3g} mm^3 at a node or "
                                 "integration point, must be positive); refine or smooth its mesh",
                                 solid, cell, det));
  return det;
}

/// The integration points see nothing of a fold at a corner or a mid-side node (corners exchanged without their
/// mid-side nodes, a mid-side node pulled too far): ask there too.
void check_nodes(const Eigen::Matrix<double, 3, 10> &x, const std::string &solid, Eigen::Index cell)
{
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j)
    {
      const Eigen::Vector4d node = 0.5 * (Eigen::Vector4d::Unit(i) + Eigen::Vector4d::Unit(j));
      positive_jacobian(x * shape_gradient(node), solid, cell);
    }
}

/// Green-Lagrange strain of F, engineering shears.
Voigt green_lagrange(const Eigen::Matrix3d &f)
{
  const Eigen::Matrix3d e = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
  Voigt v;
  v << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(0, 2), 2 * e(1, 2);
  return v;
}

/// Change of the strain with the position of a node whose shape function has the gradient g: dE = B dx.
Eigen::Matrix<double, 6, 3> strain_operator(const Eigen::Matrix3d &f, const Eigen::Vector3d &g)
{
  Eigen::Matrix<double, 6, 3> b;
  for (int i = 0; i < 3; ++i)
    b.row(i) = g[i] * f.col(i).transpose();
  b.row(3) = g[1] * f.col(0).transpose() + g[0] * f.col(1).transpose();
  b.row(4) = g[2] * f.col(0).transpose() + g[0] * f.col(2).transpose();
  b.row(5) = g[2] * f.col(1).transpose() + g[1] * f.col(2).transpose();
  return b;
}

/// Adds int S : dE and its derivative over one integration point.
void add_isochoric(const Eigen::Matrix3d &f, const TetrahedronPoint &q, const StressState &state, Vector30 &force,
                   Matrix30 &stiffness)
{
  Eigen::Matrix<double, 6, 30> b;
  for (int n = 0; n < 10; ++n)
    b.middleCols<3>(3 * n) = strain_operator(f, q.gradient.col(n));
  force += q.volume * b.transpose() * state.stress;
  stiffness += q.volume * b.transpose() * state.tangent * b;
  Eigen::Matrix3d s;
  s << state.stress[0], state.stress[3], state.stress[4], //
      state.stress[3], state.stress[1], state.stress[5],  //
      state.stress[4], state.stress[5], state.stress[2];
  const Eigen::Matrix<double, 10, 10> geometric = q.volume * q.gradient.transpose() * s * q.gradient;
  for (int m = 0; m < 10; ++m)
    for (int n = 0; n < 10; ++n)
      stiffness.block<3, 3>(3 * m, 3 * n).diagonal().array() += geometric(m, n);
}

/// Adds int J and its first two derivatives over one integration point.
void add_volume(const Eigen::Matrix3d &f, const TetrahedronPoint &q, double &volume, Vector30 &gradient,
                Matrix30 &hessian)
{
  const double v = q.volume * f.determinant();
  const Eigen::Matrix<double, 3, 10> g = f.inverse().transpose() * q.gradient; // in the current frame
  volume += v;
  gradient += v * Eigen::Map<const Vector30>(g.data());
  for (int m = 0; m < 10; ++m)
    for (int n = 0; n < 10; ++n)
      hessian.block<3, 3>(3 * m, 3 * n) += v * (g.col(m) * g.col(n).transpose() - g.col(n) * g.col(m).transpose());
}
} // namespace

QuadraticTetrahedra::QuadraticTetrahedra(const dataset::ReferenceSolid &solid, const dataset::YeohMaterial &material,
                                         int first_unknown)
    : name_(solid.name), isochoric_(material.c10, material.c20, material.c30, 0), kappa_(material.kappa),
      first_unknown_(first_unknown), rest_(solid.points)
{
  const double a = 0.58541019662496845446, c = 0.13819660112501051518; // degree 2, 4 points
  for (Eigen::Index i = 0; i < solid.cells.rows(); ++i)
  {
    Cell cell;
    cell.nodes = solid.cells.row(i).transpose();
    Eigen::Matrix<double, 3, 10> x;
    for (int n = 0; n < 10; ++n)
      x.col(n) = solid.points.row(cell.nodes[n]).transpose();
    check_nodes(x, solid.name, i);
    for (int q = 0; q < 4; ++q)
    {
      Eigen::Vector4d b = Eigen::Vector4d::Constant(c);
      b[q] = a;
      const ShapeGradient reference = shape_gradient(b);
      const Eigen::Matrix3d jacobian = x * reference;
      const double det = positive_jacobian(jacobian, solid.name, i);
      cell.points[q].gradient = (reference * jacobian.inverse()).transpose();
      cell.points[q].volume = det / 24;
      cell.volume += det / 24;
    }
    cells_.push_back(cell);
  }
}

void QuadraticTetrahedra::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  for (int n = 0; n < 10; ++n)
    for (int k = 0; k < 3; ++k)
      indices.push_back(first_unknown_ + 3 * cells_[item].nodes[n] + k);
}

void QuadraticTetrahedra::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  const Cell &cell = cells_[item];
  unknowns(item, local.unknowns);
  Eigen::Matrix<double, 3, 10> x;
  for (int n = 0; n < 10; ++n)
    x.col(n) = rest_.row(cell.nodes[n]).transpose() + solution.segment<3>(first_unknown_ + 3 * cell.nodes[n]);

  Vector30 force = Vector30::Zero(), d_volume = Vector30::Zero(); // d_volume: derivative of the cell's volume
  Matrix30 stiffness = Matrix30::Zero(), d2_volume = Matrix30::Zero();
  double volume = 0;
  local.energy = 0;
  for (const TetrahedronPoint &q : cell.points)
  {
    const Eigen::Matrix3d f = x * q.gradient.transpose();
    const StressState state = isochoric_.evaluate(green_lagrange(f));
    local.energy += q.volume * state.energy;
    add_isochoric(f, q, state, force, stiffness);
    add_volume(f, q, volume, d_volume, d2_volume);
  }
  const double dilatation = volume / cell.volume - 1, pressure = kappa_ * dilatation;
  local.energy += 0.5 * pressure * dilatation * cell.volume;
  local.residual = force + pressure * d_volume;
  local.tangent = stiffness + kappa_ / cell.volume * d_volume * d_volume.transpose() + pressure * d2_volume;
}
} // namespace pelvireg::reference_fe
