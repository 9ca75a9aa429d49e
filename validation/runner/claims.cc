#include "validation/runner/claims.h"

#include "validation/runner/aggregate.h"
#include "validation/runner/claim_terms.h"
#include "validation/runner/condition_table.h"

#include <fmt/format.h>

namespace pelvireg::runner
{
std::string to_verdict(bool holds)
{
  return holds ? "confirmed" : "refuted";
}

ClaimVerdict not_assessed(ClaimVerdict claim, const std::string &reason)
{
  claim.verdict = "not assessed";
  claim.ours = reason;
  return claim;
}

void append_phrase(std::string &list, const std::string &phrase)
{
  list += (list.empty() ? "" : "; ") + phrase;
}

double last_error(const Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  return error_by_step(evaluation, condition, organ).back().mean;
}

bool needs(const Evaluation &evaluation, const std::vector<std::string> &conditions, ClaimVerdict &claim)
{
  for (const std::string &condition : conditions)
    if (!has_condition(evaluation, condition))
    {
      claim = not_assessed(claim, fmt::format("condition '{}' was not run", condition));
      return false;
    }
  return true;
}

bool needs_sound(const Evaluation &evaluation, const std::vector<std::string> &conditions, ClaimVerdict &claim)
{
  if (!needs(evaluation, conditions, claim))
    return false;
  for (const std::string &condition : conditions)
    if (const OutlineFit fit = outline_fit(evaluation, condition); !fit.is_followed())
    {
      claim = not_assessed(claim,
                           fmt::format("'{}' did not follow the image: {} of {} steps failed, acceptance {:.0f} "
                                       "%, mean in-plane residual {:.2f} mm (asked: 0, 90 %, 0.30 mm)",
                                       condition, fit.n_failed_steps, fit.n_steps, 100 * fit.acceptance, fit.residual));
      return false;
    }
  return true;
}

namespace
{
/// Mean surface error of the nominal run at the last step, all constraints on; empty when it was not judged.
std::string floor_phrase(const Evaluation &evaluation)
{
  std::string phrase;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == full && row.sample == 0 && row.step == evaluation.n_steps())
      phrase += fmt::format("{} {} {:.3f} mm", phrase.empty() ? ":" : ",", row.organ, row.distance.mean);
  return phrase;
}
} // namespace

std::string inverse_crime_notice(const Evaluation &evaluation)
{
  return evaluation.is_inverse_crime
             ? fmt::format(
                   "INVERSE CRIME: the registration itself made this truth ({}). Its errors are those of the "
                   "model against itself; of the nominal run (sample 0, full) they are the method's own floor{}.",
                   evaluation.truth_source, floor_phrase(evaluation))
             : "";
}

std::vector<ClaimVerdict> assess_claims(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  std::vector<ClaimVerdict> claims = {better_than_unregistered(evaluation), below_four_mm(evaluation),
                                      small_motion_ratio(evaluation),       growth_by_slice(evaluation),
                                      large_motion_ratio(evaluation),       spread_over_runs(evaluation),
                                      frame_rate(evaluation, timings)};
  if (evaluation.is_inverse_crime)
    for (ClaimVerdict &claim : claims)
      claim.ours = "[inverse crime] " + claim.ours;
  return claims;
}
} // namespace pelvireg::runner
