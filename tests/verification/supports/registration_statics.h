// Small linear statics of bodies of the registration, dense: what its supports are worth.
#pragma once

#include "synthetic/dataset/anatomy.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pelvireg::test
{
/// Mean displacement of `nodes` of an organ (mm) in columns x, y, z under a force of 1 N along x, y, z, shared evenly
/// by them: the organ with its fixed nodes and the grid that is attached to it, at rest.
Eigen::Matrix3d compliance_of_organ(const dataset::RegistrationModel &model, const std::string &organ,
                                    const std::string &grid, const std::vector<int> &nodes);

/// Force on the organ's end of one attached grid (N) in columns x, y, z when that end is moved by 1 mm along x, y, z,
/// undeformed, at rest.
Eigen::Matrix3d stiffness_of_band(const dataset::RegistrationModel &model,
                                  const dataset::RegistrationAttachment &attachment);
} // namespace pelvireg::test
