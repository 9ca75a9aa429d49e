// What the page says first: verdict, error table, the paper's claims and our aims.
#pragma once

#include "validation/report/worst_places.h"
#include "validation/runner/aims.h"
#include "validation/runner/claims.h"

#include <string>
#include <vector>

namespace pelvireg::report
{
/// "confirmed", "met", … with a sign and a colour.
std::string verdict_mark(const std::string &verdict);

/// How many claims hold.
std::string verdict_sentence(const std::vector<runner::ClaimVerdict> &claims);

/// Mean surface error by condition and organ: last step, largest over the steps, against doing nothing; and what the
/// truth itself does not know.
std::string error_table_html(const runner::Evaluation &evaluation, const dataset::Truth &truth);

/// For which organs the truth's own error bar is not smaller than what is measured against it; empty when for none.
std::string error_bar_sentence(const runner::Evaluation &evaluation, const dataset::Truth &truth);

/// One row a claim or aim, with its verdict.
std::string claims_html(const std::vector<runner::ClaimVerdict> &claims);
std::string aims_html(const std::vector<runner::Aim> &aims);

/// The values behind the figures: mean ± standard deviation by step and by slice, one closed table a condition.
std::string step_tables_html(const runner::Evaluation &evaluation);
std::string slice_tables_html(const runner::Evaluation &evaluation);

/// Slices that have no value.
std::string missed_html(const runner::Evaluation &evaluation);

/// One table a condition.
std::string worst_places_html(const runner::Evaluation &evaluation, const std::vector<WorstPlace> &places);
} // namespace pelvireg::report
