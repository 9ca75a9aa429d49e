#include "reference_fe/materials/invariant_law.h"

#include <cmath>

namespace pelvireg::reference_fe
{
namespace
{
const Voigt identity = (Voigt() << 1, 1, 1, 0, 0, 0).finished();

/// C in tensor components (no engineering factors).
Voigt right_cauchy_green(const Voigt &strain)
{
  Voigt c = identity;
  c.head<3>() += 2 * strain.head<3>();
  c.tail<3>() += strain.tail<3>();
  return c;
}

/// Cofactors of C: inverse times determinant.
Voigt cofactors(const Voigt &c)
{
  return (Voigt() << c[1] * c[2] - c[5] * c[5], c[0] * c[2] - c[4] * c[4], c[0] * c[1] - c[3] * c[3],
          c[4] * c[5] - c[3] * c[2], c[3] * c[5] - c[4] * c[1], c[3] * c[4] - c[5] * c[0])
      .finished();
}

/// (A_ik A_jl + A_il A_jk) / 2 of a symmetric A: minus the derivative of the inverse.
VoigtMatrix symmetric_product(const Voigt &a)
{
  static constexpr int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  static constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  VoigtMatrix product;
  for (int m = 0; m < 6; ++m)
    for (int n = m; n < 6; ++n)
    {
      const int i = first[m], j = second[m], k = first[n], l = second[n];
      product(m, n) = 0.5 * (a[at[i][k]] * a[at[j][l]] + a[at[i][l]] * a[at[j][k]]);
      product(n, m) = product(m, n);
    }
  return product;
}

VoigtMatrix symmetrised(const Voigt &a, const Voigt &b)
{
  return a * b.transpose() + b * a.transpose();
}
} // namespace

StressState InvariantLaw::evaluate(const Voigt &green_lagrange) const
{
  const Voigt c = right_cauchy_green(green_lagrange);
  const Voigt cofactor = cofactors(c);
  const double det = c[0] * cofactor[0] + c[3] * cofactor[3] + c[4] * cofactor[4];
  const double j = std::sqrt(det); // NaN when inverted
  const Voigt inverse = cofactor / det;
  const double i1 = c[0] + c[1] + c[2];
  const double i2 = cofactor[0] + cofactor[1] + cofactor[2];
  const double j23 = 1 / std::cbrt(det), j43 = j23 * j23;
  const IsochoricEnergy w = isochoric(j23 * i1, j43 * i2);

  // First derivatives of I1bar, I2bar with respect to C.
  const Voigt e = i1 * identity - c;
  const Voigt a = j23 * (identity - (i1 / 3) * inverse);
  const Voigt b = j43 * (e - (2 * i2 / 3) * inverse);

  const VoigtMatrix inverse_squared = inverse * inverse.transpose();
  const VoigtMatrix inverse_product = symmetric_product(inverse);

  StressState state;
  state.energy = w.value + 0.5 * kappa_ * (j - 1) * (j - 1);
  state.stress = 2 * w.d1 * a + 2 * w.d2 * b + kappa_ * (j * j - j) * inverse;
  // 4 d2W/dCdC: second derivatives of W, then of I1bar, of I2bar, then the volumetric part.
  state.tangent = kappa_ * (j * (2 * j - 1) * inverse_squared - 2 * (j * j - j) * inverse_product);
  state.tangent +=
      4 * w.d1 * j23 * ((i1 / 9) * inverse_squared + (i1 / 3) * inverse_product - symmetrised(identity, inverse) / 3);
  if (w.d11 != 0)
    state.tangent += 4 * w.d11 * a * a.transpose();
  if (w.d2 != 0 || w.d12 != 0 || w.d22 != 0)
  {
    state.tangent += 4 * w.d12 * symmetrised(a, b) + 4 * w.d22 * b * b.transpose();
    VoigtMatrix second = (4 * i2 / 9) * inverse_squared + (2 * i2 / 3) * inverse_product -
                         (2.0 / 3) * symmetrised(e, inverse) + identity * identity.transpose();
    second.diagonal().head<3>().array() -= 1;
    second.diagonal().tail<3>().array() -= 0.5;
    state.tangent += 4 * w.d2 * j43 * second;
  }
  return state;
}
} // namespace pelvireg::reference_fe
