// The judge: compare every registered run, and doing nothing, with the truth.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/truth.h"
#include "validation/runner/evaluation.h"
#include "validation/runner/run_source.h"

#include <vector>

namespace pelvireg::runner
{
/// Compare. `estimates` may be empty: then only `unregistered` is judged. Fails closed with InputError, one sentence:
/// another case, a missing or repeated organ, condition or sample, a missing step, a position that is not finite or
/// metres away, an open surface, a truth or estimate that the DYN plane misses at the last step. Of several broken runs
/// the first one is named.
Evaluation evaluate(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                    const std::vector<dataset::Estimate> &estimates, const EvaluateOptions &options = {});

/// The same, run by run: each is asked for once and let go when it is judged, so that one a thread is in memory.
Evaluation evaluate_runs(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                         const std::vector<RunSource> &estimates, const EvaluateOptions &options = {});
} // namespace pelvireg::runner
