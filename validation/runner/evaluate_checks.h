// What must hold before anything is compared: the judge fails closed.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// The truth's surface of an organ. Throws InputError when it is missing.
const dataset::TruthSurface &truth_surface(const dataset::Truth &truth, const std::string &organ);

/// Throws InputError, one sentence, unless truth and estimates are complete, finite, and of the anatomy's case.
void require_comparable(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                        const std::vector<dataset::Estimate> &estimates);
} // namespace pelvireg::runner
