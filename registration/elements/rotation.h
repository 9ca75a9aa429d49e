// Rotation of a corotational element.
#pragma once

#include <Eigen/Core>

namespace pelvireg::registration
{
/// Rotation Q(F) of the polar decomposition F = Q S of a deformation gradient (any 3 x 3 matrix), det Q = +1.
/// A pure stretch gives the identity, whatever the numbering of the element's nodes. For det F > 0 it is the polar
/// factor (scaled Newton iteration: Higham, SIAM J. Sci. Stat. Comput. 7, 1986, algorithm CGN). A flat or inverted F
/// gets the nearest proper rotation, from the singular value decomposition with the smallest singular value negated
/// (Irving, Teran & Fedkiw, SCA 2004). F = 0 gives the identity.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d &deformation_gradient);
} // namespace pelvireg::registration
