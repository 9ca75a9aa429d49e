// How long everything took.
#pragma once

#include "validation/report/report.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// Seconds of each stage; milliseconds of a step of the registration, whole and by phase. What was not recorded is said
/// in a sentence.
std::string time_html(const std::vector<StageTime> &stages, const std::vector<runner::StepTiming> &timings);
} // namespace pelvireg::report
