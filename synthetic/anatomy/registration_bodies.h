// The registration's discretisation: hollow and full tetrahedra, hexahedral grids, attachments.
#pragma once

#include "synthetic/anatomy/organs.h"

namespace pelvireg::anatomy
{
/// All bodies in the order of the contract and their attachments. Node counts of the organs within 5 % of the case's.
dataset::RegistrationModel make_registration(const Parameters &parameters);

/// Grids of the supports: adds to `model` (whose organs exist already) the bodies fascia_pelvis, fascia_sacrum and
/// ligaments and one attachment a band.
void add_bands(const Parameters &parameters, dataset::RegistrationModel &model);
} // namespace pelvireg::anatomy
