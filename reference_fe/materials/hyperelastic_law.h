// Hyperelastic laws: energy, second Piola-Kirchhoff stress and tangent as functions of C = F^T F.
#pragma once

#include <Eigen/Core>

namespace pelvireg::reference_fe
{
/// Symmetric tensors in Voigt order 11, 22, 33, 12, 13, 23; strains carry engineering shears (2 E12, …).
using Voigt = Eigen::Matrix<double, 6, 1>;
using VoigtMatrix = Eigen::Matrix<double, 6, 6>;

struct StressState
{
  double energy = 0;   ///< W, MPa = N mm per mm^3 of rest volume
  Voigt stress;        ///< S = 2 dW/dC, MPa
  VoigtMatrix tangent; ///< dS/dE, MPa, symmetric
};

/// One material. Isotropic, so that S and D may be asked in any Cartesian frame.
class HyperelasticLaw
{
public:
  virtual ~HyperelasticLaw() = default;
  /// `green_lagrange` is E = (C - I)/2 in a Cartesian frame, engineering shears. All outputs are NaN when C is not
  /// positive definite by its determinant (an inverted cell).
  virtual StressState evaluate(const Voigt &green_lagrange) const = 0;
};
} // namespace pelvireg::reference_fe
