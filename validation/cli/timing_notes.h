// Step times as a register stage notes them in the manifest.
#pragma once

#include "validation/cli/stage_cache.h"
#include "validation/runner/register.h"

#include <optional>
#include <string>

namespace pelvireg::cli
{
/// n_steps; median_ms, p95_ms, max_ms, mean_ms of a step; PHASE_mean_ms of every phase.
Notes notes_of(const runner::StepTiming &timing);

/// What notes_of() noted for the estimate `label`; without phases when the notes have none (an older program's), none
/// when they hold no step times.
std::optional<runner::StepTiming> timing_in(const Notes &notes, const std::string &label);
} // namespace pelvireg::cli
