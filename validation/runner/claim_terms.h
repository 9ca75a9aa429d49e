// Words and checks that the claims share.
#pragma once

#include "validation/runner/claims.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
inline const std::string full = "full";
inline const std::string bare = "no_boundary_conditions";

std::string to_verdict(bool holds);

/// The claim as not assessed, for a reason.
ClaimVerdict not_assessed(ClaimVerdict claim, const std::string &reason);

/// Joins phrases with semicolons.
void append_phrase(std::string &list, const std::string &phrase);

/// Mean surface error of an organ at the last step, mm.
double last_error(const Evaluation &evaluation, const std::string &condition, const std::string &organ);

/// Large motion: the vagina's largest displacement above 25 mm. Small: its mean in-plane displacement within 0.5 mm of
/// 8.2 mm. Both as in the paper; a case may be neither.
bool is_large(const Evaluation &evaluation);
bool is_small(const Evaluation &evaluation);
std::string motion_phrase(const Evaluation &evaluation);

/// Was every condition judged? When not, the claim becomes "not assessed" and false is returned.
bool needs(const Evaluation &evaluation, const std::vector<std::string> &conditions, ClaimVerdict &claim);

/// needs(), and each of the conditions must have followed the image (condition_table.h): a ratio must not come from a
/// broken ablation.
bool needs_sound(const Evaluation &evaluation, const std::vector<std::string> &conditions, ClaimVerdict &claim);

// The claims of DESIGN 5.3, one each.
ClaimVerdict better_than_unregistered(const Evaluation &evaluation);
ClaimVerdict below_four_mm(const Evaluation &evaluation);
ClaimVerdict small_motion_ratio(const Evaluation &evaluation);
ClaimVerdict growth_by_slice(const Evaluation &evaluation);
ClaimVerdict large_motion_ratio(const Evaluation &evaluation);
ClaimVerdict spread_over_runs(const Evaluation &evaluation);
ClaimVerdict frame_rate(const Evaluation &evaluation, const std::vector<StepTiming> &timings);
} // namespace pelvireg::runner
