// A comparison in words: for the terminal, a CI's summary page, a CI's test list and for programs.
#pragma once

#include "validation/regression/compare.h"

#include <string>
#include <vector>

namespace pelvireg::regression
{
/// The families, grave verdicts first, otherwise in order.
std::vector<const FamilyComparison *> by_gravity(const Comparison &comparison);

/// "PASS: 26 of 26 …" in one line.
std::string headline(const Comparison &comparison);

/// Plain text: one line a family, what is not PASS first said in full. Ends with a newline.
std::string comparison_table(const Comparison &comparison);

/// GitHub-flavoured Markdown: headline, table, families that pass folded away. For $GITHUB_STEP_SUMMARY or a comment.
std::string comparison_markdown(const Comparison &comparison);

/// JUnit XML: one test case a family; WORSE is a failure, INCOMPARABLE and MISSING are errors.
std::string comparison_junit(const Comparison &comparison);

/// Everything, for programs: format "pelvireg comparison", see docs/result_format.md.
std::string comparison_json(const Comparison &comparison);

/// "full", "vagina", "mean error by step": what a family is called in tables.
std::string curve_title(const FamilyComparison &family);

/// Change of E, "+1.20 %"; "-" when the family could not be compared.
std::string change_text(const FamilyComparison &family);
/// The two one-sided bounds of it, "+0.9 … +1.5"; "-" when there are none.
std::string bounds_text(const FamilyComparison &family);
/// Reasons and warnings in one line.
std::string remarks_text(const FamilyComparison &family);
} // namespace pelvireg::regression
