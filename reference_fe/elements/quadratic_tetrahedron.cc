#include "reference_fe/elements/quadratic_tetrahedron.h"

#include "synthetic/dataset/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <cmath>

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

/// Isochoric Yeoh law in terms of F: W(I1bar), first Piola-Kirchhoff stress P and dP/dF applied through contractions.
struct Isochoric
{
  Isochoric(const Eigen::Matrix3d &f, const dataset::YeohMaterial &m)
      : j(f.determinant()), f_inverse_t(f.inverse().transpose()), scale(std::pow(j, -2. / 3)), i1(f.squaredNorm())
  {
    const double e = scale * i1 - 3;
    energy = m.c10 * e + m.c20 * e * e + m.c30 * e * e * e;
    w1 = m.c10 + 2 * m.c20 * e + 3 * m.c30 * e * e;
    w2 = 2 * m.c20 + 6 * m.c30 * e;
    d_i1 = scale * (2 * f - 2. / 3 * i1 * f_inverse_t);
  }

  double j;
  Eigen::Matrix3d f_inverse_t;
  double scale, i1, energy = 0, w1 = 0, w2 = 0;
  Eigen::Matrix3d d_i1; ///< dI1bar/dF; P = w1 d_i1
};
} // namespace

QuadraticTetrahedra::QuadraticTetrahedra(const dataset::ReferenceSolid &solid, const dataset::YeohMaterial &material,
                                         int first_unknown)
    : name_(solid.name), material_(material), first_unknown_(first_unknown), rest_(solid.points)
{
  const double a = 0.58541019662496845446, c = 0.13819660112501051518; // degree 2, 4 points
  for (Eigen::Index i = 0; i < solid.cells.rows(); ++i)
  {
    Cell cell;
    cell.nodes = solid.cells.row(i).transpose();
    Eigen::Matrix<double, 3, 10> x;
    for (int n = 0; n < 10; ++n)
      x.col(n) = solid.points.row(cell.nodes[n]).transpose();
    for (int q = 0; q < 4; ++q)
    {
      Eigen::Vector4d b = Eigen::Vector4d::Constant(c);
      b[q] = a;
      const ShapeGradient reference = shape_gradient(b);
      const Eigen::Matrix3d jacobian = x * reference;
      const double det = jacobian.determinant();
      if (!(det > 0))
        throw InputError(fmt::format("solid '{}': tetrahedron {} is inverted (Jacobian {:.3g} at an integration point, "
                                     "must be positive); refine or smooth its mesh",
                                     solid.name, i, det));
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

  Vector30 force = Vector30::Zero(), d_volume = Vector30::Zero(); // d_volume: derivative of the cell's current volume
  Matrix30 stiffness = Matrix30::Zero(), d2_volume = Matrix30::Zero();
  local.energy = 0;
  for (const IntegrationPoint &q : cell.points)
  {
    const Isochoric law(x * q.gradient.transpose(), material_);
    const Eigen::Matrix<double, 3, 10> g = law.f_inverse_t * q.gradient; // gradient in the current frame
    const Eigen::Matrix<double, 3, 10> b = law.d_i1 * q.gradient;
    const Eigen::Matrix<double, 3, 10> fg = x * q.gradient.transpose() * q.gradient;
    const Eigen::Matrix<double, 10, 10> gradient_products = q.gradient.transpose() * q.gradient;
    const Eigen::Map<const Vector30> b_all(b.data()), g_all(g.data()), fg_all(fg.data());
    local.energy += q.volume * law.energy;
    force += q.volume * law.w1 * b_all;
    d_volume += q.volume * law.j * g_all;
    // d2 I1bar = s [2 I - 4/3 (F x F^-T + F^-T x F) + 4/9 I1 F^-T x F^-T + 2/3 I1 (F^-T . F^-T crossed)].
    stiffness += q.volume * law.w2 * b_all * b_all.transpose();
    const double s = q.volume * law.w1 * law.scale;
    stiffness += s * (-4. / 3 * (fg_all * g_all.transpose() + g_all * fg_all.transpose()) +
                      4. / 9 * law.i1 * g_all * g_all.transpose());
    for (int m = 0; m < 10; ++m)
      for (int n = 0; n < 10; ++n)
      {
        const Eigen::Matrix3d crossed = g.col(n) * g.col(m).transpose();
        stiffness.block<3, 3>(3 * m, 3 * n) +=
            s * (2 * gradient_products(m, n) * Eigen::Matrix3d::Identity() + 2. / 3 * law.i1 * crossed);
        d2_volume.block<3, 3>(3 * m, 3 * n) += q.volume * law.j * (g.col(m) * g.col(n).transpose() - crossed);
      }
  }
  // Volumetric part on the cell's mean dilatation.
  const double v0 = cell.volume;
  double v = 0;
  for (const IntegrationPoint &q : cell.points)
    v += q.volume * Eigen::Matrix3d(x * q.gradient.transpose()).determinant();
  const double pressure = material_.kappa * (v / v0 - 1);
  local.energy += 0.5 * pressure * (v / v0 - 1) * v0;
  local.residual = force + pressure * d_volume;
  local.tangent = stiffness + material_.kappa / v0 * d_volume * d_volume.transpose() + pressure * d2_volume;
}
} // namespace pelvireg::reference_fe
