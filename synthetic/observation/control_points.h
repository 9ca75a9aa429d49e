// Control points: what the tracking of a dynamic image would hand to the registration.
#pragma once

#include "synthetic/observation/plane_intersection.h"

#include <vector>

namespace pelvireg::observation
{
/// The outer outline of one organ in one plane.
struct OrganSection
{
  dataset::SurfaceMesh surface; ///< deformed
  std::vector<PlaneLoop> loops;
};

struct ControlPoints
{
  dataset::Points points;  ///< k x 3, mm, on the outline
  dataset::Points normals; ///< k x 3, unit, in the plane, outward
};

/// Places control points on every frame of one examination.
///
/// *Where.* Along the outer loops, on segments of region wall and peritoneal. Not on caps (there is no wall), and not
/// on the cervix patch, neither of the vagina nor of the uterus: each hides the other there, and an image shows no
/// border between them. A maximal run of such segments is a *stretch*: open (between two excluded parts) or the whole
/// loop.
///
/// *How many.* The wanted total is shared out over all stretches of all organs at rest in proportion to their length
/// (largest remainder), hence one spacing for all organs; or, for a given spacing, each gets round(length / spacing).
/// Scraps shorter than half a spacing get none. A later frame keeps the number of each stretch as long as the organ
/// shows the same stretches; if a stretch appears, vanishes or splits, the organ's stretches get round(length / rest
/// spacing) in that frame.
///
/// *From where.* Point j of n lies at (j + 1/2)/n of an open stretch: half a spacing from a cap or the cervix patch. On
/// a closed stretch, at (j + 1/2)/n from its anchor: at rest the lowest point of the loop, later the point of the loop
/// nearest to where the anchor's material point has moved. So points follow the organ and do not jump between frames.
///
/// *Normals.* The angle-weighted vertex normals of the visible wall, interpolated in the cut triangle and projected
/// into the plane: the smooth contour's normal, not the facet's.
class ControlPointLayout
{
public:
  /// @param rest          the organs at rest, in a fixed order
  /// @param n_wanted      total number (>= 1); ignored for spacing > 0
  /// @param spacing       mm along the outline; 0: from n_wanted
  /// Throws InputError when the plane meets no visible wall at all.
  ControlPointLayout(const std::vector<OrganSection> &rest, int n_wanted, double spacing);

  /// Control points of organ `organ` on its section in a frame (the same mesh, deformed; or the rest section itself).
  ControlPoints place(std::size_t organ, const OrganSection &section) const;

  /// mm along the rest outlines.
  double spacing() const { return spacing_; }

private:
  /// A material point: triangle of the surface and barycentric coordinates.
  struct MaterialPoint
  {
    std::int32_t triangle = 0;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  };
  /// A stretch at rest: what later frames are compared with.
  struct RestStretch
  {
    MaterialPoint start; ///< an open stretch's first point, a closed one's anchor
    bool closed = false;
    int n_points = 0;
  };

  double spacing_ = 0;
  std::vector<std::vector<RestStretch>> rest_; ///< by organ
};
} // namespace pelvireg::observation
