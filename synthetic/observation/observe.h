// From the truth's moving surfaces to what a clinic would have.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

namespace pelvireg::observation
{
/// Outlines of the four organs in the DYN plane at rest and at each increment, with control points; the validation
/// slices at the last increment. Throws InputError when truth and anatomy are of different cases, when an organ is
/// missing or its surface is not closed.
dataset::Observations observe(const dataset::Anatomy &anatomy, const dataset::Truth &truth);
} // namespace pelvireg::observation
