// What must hold before anything is compared: the judge fails closed.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"
#include "validation/runner/run_source.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// The truth's surface of an organ. Throws InputError when it is missing.
const dataset::TruthSurface &truth_surface(const dataset::Truth &truth, const std::string &organ);

/// Throws InputError, one sentence, unless the truth is complete, finite, and of the anatomy's case, and the estimates
/// are of that case and each run is there once.
void require_comparable(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                        const std::vector<RunSource> &estimates);

/// Throws InputError, one sentence, unless the run of the estimate `label` is complete and finite.
void require_usable_run(const std::string &label, const dataset::EstimateSample &sample, int n_steps);
} // namespace pelvireg::runner
