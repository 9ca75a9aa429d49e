// The table that the terminal shows.
#pragma once

#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// Plain text, aligned, at most 110 columns: mean surface error of each organ by condition (last step, largest over
/// the steps, reduction) with its residual in the image plane, further metrics at the last step, motion of the truth,
/// quality of the runs, verdicts. Marked in every block when the registration made the truth. Ends with a newline.
std::string error_table(const Evaluation &evaluation, const std::vector<StepTiming> &timings = {});
} // namespace pelvireg::runner
