// The standing text of the report: style, definitions, limits.
#pragma once

#include "validation/runner/evaluate.h"

#include <string>

namespace pelvireg::report
{
/// Everything up to and including the opening of <main>.
std::string page_head(const std::string &title);

/// One meaning for every figure on the page (DESIGN 4).
std::string definitions_html(const runner::Evaluation &evaluation);

/// What the comparison does not show.
std::string limits_html();
} // namespace pelvireg::report
