// The paper's claims (DESIGN 5.3) against our numbers.
#pragma once

#include "validation/runner/evaluate.h"
#include "validation/runner/register.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// "confirmed", "refuted", or "not assessed" with the reason in `ours`.
struct ClaimVerdict
{
  std::string id;        ///< short, stable, for programs: "below_4_mm"
  std::string claim;     ///< what the paper says
  std::string paper;     ///< the paper's figure
  std::string criterion; ///< what we ask for before we call it confirmed
  std::string ours;      ///< our numbers, or why there are none
  std::string verdict;
};

/// What every table of errors must say when the registration itself made the truth; empty otherwise.
std::string inverse_crime_notice(const Evaluation &evaluation);

/// All claims in the order of DESIGN 5.3. Numbers only from `evaluation` and `timings`. Each is marked in
/// `ours` when the registration itself made the truth.
std::vector<ClaimVerdict> assess_claims(const Evaluation &evaluation, const std::vector<StepTiming> &timings);
} // namespace pelvireg::runner
