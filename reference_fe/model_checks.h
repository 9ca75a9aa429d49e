// What must hold before the solve starts.
#pragma once

#include "synthetic/dataset/anatomy.h"

namespace pelvireg::reference_fe
{
/// Throws InputError (one sentence) for: an unknown material or one that is not positive, a bar that ends nowhere, a
/// part held by nothing, an inverted shell cell (Jacobian at zeta = -1, 0, 1), an open surface where a cavity is asked,
/// a node that belongs to no cell, a target displacement or number of increments that is not positive.
void check_model(const dataset::ReferenceModel &model);
} // namespace pelvireg::reference_fe
