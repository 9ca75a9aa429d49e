// Faults to be built into the registration, so that tests can see whether the regression gate catches them. Only a test
// program sets them: no option of a program, no case file and no environment variable reaches them.
#pragma once

namespace pelvireg::registration
{
struct Mutation
{
  bool unprojected_normals = false; ///< sliding rows along the surface's normal instead of its part in the image plane
  bool stale_rotations = false;     ///< elements keep the rotation of rest
  int dropped_attachment = -1;      ///< index into Model::attachments; -1: none
  int wrong_body = -1;              ///< body whose Young's modulus is wrong; -1: none
  double wrong_factor = 1;          ///< its Young's modulus is multiplied by this
};
} // namespace pelvireg::registration
