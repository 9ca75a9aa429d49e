// The standing text of the report: style, definitions, limits.
#pragma once

#include "validation/runner/evaluate.h"

#include <string>
#include <string_view>

namespace pelvireg::report
{
/// Everything up to and including the opening of <main>. `script_digest`: base64 of the SHA-256 of the one script that
/// the page may run; empty: none.
std::string page_head(const std::string &title, std::string_view script_digest = {});

/// Jumps to the parts of the report.
std::string page_links();

/// One meaning for every figure on the page (DESIGN 4).
std::string definitions_html(const runner::Evaluation &evaluation);

/// What the comparison does not show.
std::string limits_html(bool has_tracked_outlines);
} // namespace pelvireg::report
