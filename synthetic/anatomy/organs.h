// The outer surfaces of the organs as charts, at a mesh size.
#pragma once

#include "synthetic/anatomy/axis.h"
#include "synthetic/anatomy/outer_surface.h"
#include "synthetic/anatomy/parameters.h"

#include <vector>

namespace pelvireg::anatomy
{
/// `size` mm: aimed edge length of the quadrilaterals. All surfaces are closed but for the rims of the tubes.
std::vector<Chart> bladder_charts(const BladderShape &shape, double size);
/// With the patch of the uterus marked. `aspect`: length over width of the cells.
std::vector<Chart> vagina_charts(const VaginaShape &vagina, const UterusShape &uterus, double size, double aspect = 1);
std::vector<Chart> uterus_charts(const UterusShape &uterus, const VaginaShape &vagina, double size);
std::vector<Chart> rectum_charts(const RectumShape &shape, double size);
/// The mid-surface, normals cranial: the bowl, and behind it, with edge_radius, a quarter turn down over the bone.
std::vector<Chart> floor_charts(const FloorShape &shape, double size);

/// The planar, elliptic patch in which the cervix ends on the straight anterior wall of the vagina.
struct CervixPatch
{
  Eigen::Vector3d centre; ///< mm, on the vagina's outer surface
  Eigen::Vector3d normal; ///< unit, out of the vagina (into the uterus)
  Eigen::Vector3d axis;   ///< unit, of the cervix, cranial
  double radius = 0;      ///< of the cervix there
  bool contains(const Eigen::Vector3d &point) const;
};
CervixPatch cervix_patch(const UterusShape &uterus, const VaginaShape &vagina);

/// A point of the undeviated uterus turned to the left about the antero-posterior axis through `centre`.
Eigen::Vector3d deviated(const Eigen::Vector3d &point, const Eigen::Vector3d &centre, double degrees);

/// The two patches of a support on one side, in place: mirrored for the right side; what is fastened to the uterus
/// follows its deviation.
struct SupportPatches
{
  Eigen::Vector3d organ_point, organ_span, far_point, far_span;
  double area = 0; ///< mm^2
};
SupportPatches support_patches(const Support &support, bool left, const Parameters &parameters);

/// Number of cells of about `size` along `length`, at least `least`.
int count(double length, double size, int least = 1);
} // namespace pelvireg::anatomy
