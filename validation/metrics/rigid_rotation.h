// The rotation that best explains how points moved.
#pragma once

#include "synthetic/dataset/geometry.h"

namespace pelvireg::metrics
{
/// The rotation R that, with a translation, carries `from` to `to` with the least sum of squared distances (Kabsch
/// 1976, by singular values; never a reflection). Both k x 3, mm, row by row the same material point. Throws InputError
/// for other shapes, a value that is not finite, and points on a line (second singular value of their covariance below
/// 1e-9 of the first), for which no rotation is best.
Eigen::Matrix3d best_rotation(const dataset::Points &from, const dataset::Points &to);

/// Angle of a rotation, 0 … pi rad, exact also near both ends.
double rotation_angle(const Eigen::Matrix3d &rotation);
} // namespace pelvireg::metrics
