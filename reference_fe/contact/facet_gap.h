// Signed distance of a point from the plane of a moving facet.
#pragma once

#include <Eigen/Core>

namespace pelvireg::reference_fe
{
/// g = n . (x - a) with n the unit normal of the facet (a, b, c): positive outside, mm. The derivatives are with respect
/// to (x, a, b, c), 12 numbers. The gradient is (n, -l_a n, -l_b n, -l_c n) with l the barycentric coordinates of the
/// projection of x: action equals reaction, and no net moment.
struct FacetGap
{
  double gap = 0;
  Eigen::Matrix<double, 12, 1> gradient;
  Eigen::Matrix<double, 12, 12> hessian;
};

/// @param x columns: the point, then the corners a, b, c of the facet.
FacetGap facet_gap(const Eigen::Matrix<double, 3, 4> &x);
} // namespace pelvireg::reference_fe
