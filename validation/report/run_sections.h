// What the page says of the runs: motion, quality, provenance.
#pragma once

#include "validation/report/report.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// What was run, in a few lines.
std::string facts_html(const runner::Evaluation &evaluation);

/// How the truth moved each organ.
std::string motion_html(const runner::Evaluation &evaluation);

/// What the registration says of itself: the worst of the runs of each condition.
std::string quality_html(const runner::Evaluation &evaluation, const std::vector<runner::StepTiming> &timings);

/// The commands that make the result again, and what made it.
std::string provenance_html(const std::vector<ProvenanceEntry> &entries, const std::vector<std::string> &commands);
} // namespace pelvireg::report
