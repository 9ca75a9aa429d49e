// Sliding constraints omega: control points of an outline on a surface (paper, section 5.1, equation 4).
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/constraints/triangle_tree.h"
#include "registration/registration.h"

namespace pelvireg::registration
{
/// A control point and the point of the surface that it was matched to.
struct SlidingMatch
{
  bool is_accepted = false;
  Eigen::Vector3i nodes = Eigen::Vector3i::Zero();   ///< of the triangle
  Eigen::Vector3d weights = Eigen::Vector3d::Zero(); ///< barycentric point q_s
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero(); ///< unit: surface normal n_s at q_s, projected into the image plane
  double gap = 0;              ///< direction . (m - q_s), mm
};

/// Nearest triangle whose outward normal, projected into the image plane, agrees with the contour's normal. Refused
/// when there is none within Options::max_match_distance. A triangle (almost) parallel to the image plane has no
/// direction in it and is never matched. `plane_normal` is unit; the tree must be refitted to `positions`.
SlidingMatch match_control_point(const TriangleTree &tree, const Points &positions, const Eigen::Vector3d &point,
                                 const Eigen::Vector3d &contour_normal, const Eigen::Vector3d &plane_normal,
                                 const Options &options);

/// One row: direction . (sum of weights x node displacements) = gap. It has no component along the plane's normal, so
/// its force has none: the surface is free to slide through the plane.
void add_sliding_row(const SlidingMatch &match, int body, double compliance, ConstraintRows &rows);
} // namespace pelvireg::registration
