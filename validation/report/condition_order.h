// Conditions as the reader meets them.
#pragma once

#include "validation/runner/evaluation.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// What a condition is called in headings: "full: with boundary conditions", …
std::string condition_title(const std::string &condition);

/// The conditions of the paper, and doing nothing: what is seen at first.
bool is_main_condition(const std::string &condition);

/// full, no_boundary_conditions, unregistered, then the others in the evaluation's order.
std::vector<std::string> reading_order(const runner::Evaluation &evaluation);

/// One piece of HTML a condition, in reading order. Behind the main ones the others, if any, are closed under `others`.
std::string by_condition(const runner::Evaluation &evaluation,
                         const std::function<std::string(const std::string &)> &piece,
                         const std::string &others = "Other conditions");
} // namespace pelvireg::report
