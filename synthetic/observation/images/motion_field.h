// Where the tissue at a point in space was at rest.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "synthetic/dataset/image_series.h"

#include <vector>

namespace pelvireg::observation
{
/// Points of one or several surfaces with what they move.
struct MovedPoints
{
  dataset::Points rest;          ///< n x 3, mm
  dataset::Points displacements; ///< n x 3, mm
  Eigen::VectorXd areas;         ///< n, mm^2 of surface that each stands for
};

/// How fast the motion fades away from the surfaces that move, mm.
inline constexpr double motion_reach = 25;

/// A smooth extension of the surfaces' displacement into space, taken at deformed positions:
///   u(x) = sum a_i u_i w_i(x) / (c + sum a_i w_i(x)),  w_i = 1 / (|x - x_i|^2 + e^2)^2,  e = 1.5 mm,
/// inverse distance weighting (Shepard 1968). c = pi / motion_reach^2 when it fades: at the distance h from a large
/// flat wall that moves by U it is U / (1 + (h / motion_reach)^2), up to e. c = 0 when it does not.
Eigen::Vector3d extended_displacement(const MovedPoints &points, const Eigen::Vector3d &position, bool fades);

/// The extension on a lattice around one slice, interpolated linearly in between and held beyond.
class MotionField
{
public:
  /// @param geometry the slice; @param half_thickness mm, either side
  MotionField(const dataset::ImageGeometry &geometry, double half_thickness, const MovedPoints &points, bool fades);

  /// The field of a state between two: (1 - share) a + share b, of the same slice.
  static MotionField between(const MotionField &a, const MotionField &b, double share);

  /// mm; `position` in space. The tissue's rest position is position - displacement_at(position).
  Eigen::Vector3d displacement_at(const Eigen::Vector3d &position) const;

private:
  MotionField() = default;
  std::size_t node(int i, int j, int k) const;

  Eigen::Vector3d origin_;
  Eigen::Matrix3d axes_; ///< rows: unit directions of the lattice
  Eigen::Vector3d step_;
  Eigen::Vector3i size_;
  std::vector<Eigen::Vector3d> values_;
};
} // namespace pelvireg::observation
