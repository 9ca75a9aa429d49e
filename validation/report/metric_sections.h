// What surface distance does not see: the page's tables of further metrics.
#pragma once

#include "validation/runner/evaluate.h"

#include <string>

namespace pelvireg::report
{
/// Material-point error, symmetric distances, Dice, volume and rotation at the last step; one table a condition.
std::string metrics_html(const runner::Evaluation &evaluation);

/// Surface and material-point error by distance from the DYN plane at the last step; one closed table a condition.
std::string distance_tables_html(const runner::Evaluation &evaluation);

/// Smallest volume ratio of the registration's elements, and how deep organs reach into each other, over all runs.
std::string elements_html(const runner::Evaluation &evaluation);
std::string penetrations_html(const runner::Evaluation &evaluation);
} // namespace pelvireg::report
