// Claims on many runs and on their speed.
#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claim_terms.h"
#include "validation/runner/table_one.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

constexpr int n_runs_for_spread = 10; ///< fewer runs say nothing of a standard deviation
constexpr double modulus_spread = 0.10;

// Of the paper's "on average 30 friction contact and 70 outline constraints": fewer would be an easier problem.
constexpr double least_outline_constraints = 60, least_contacts = 15;

const RunQuality *nominal_run(const Evaluation &evaluation, const std::string &condition)
{
  for (const RunQuality &run : evaluation.quality)
    if (run.condition == condition && run.sample == 0)
      return &run;
  return nullptr;
}

double largest_sd(const std::vector<Aggregate> &by_step)
{
  double sd = 0;
  for (const Aggregate &step : by_step)
    sd = std::max(sd, step.sd);
  return sd;
}
} // namespace

ClaimVerdict spread_over_runs(const Evaluation &evaluation)
{
  ClaimVerdict claim{
      "spread_over_runs",
      "Standard deviation over 100 runs with Young's moduli +/- 10 %: small; almost nil without boundary "
      "conditions",
      "yes",
      "standard deviation of the mean error at the last step at most 10 % of it with, and at most 1 % "
      "without boundary conditions, every organ",
      "",
      ""};
  if (!needs_sound(evaluation, {full, bare}, claim))
    return claim;
  const int n_runs = std::min(n_randomised_runs(evaluation, full), n_randomised_runs(evaluation, bare));
  if (n_runs < n_runs_for_spread)
    return not_assessed(
        claim, fmt::format("{} randomised runs a condition, at least {} are needed", n_runs, n_runs_for_spread));
  for (const std::string &condition : {full, bare})
  {
    const auto spread = evaluation.modulus_spreads.find(condition);
    if (spread == evaluation.modulus_spreads.end() || !(std::abs(spread->second - modulus_spread) <= 1e-9))
      return not_assessed(claim, fmt::format("the moduli of '{}' were not spread by 10 %", condition));
  }
  bool holds = true;
  for (const std::string &organ : organ_names)
  {
    const auto with = error_by_step(evaluation, full, organ), without = error_by_step(evaluation, bare, organ);
    holds = holds && with.back().sd <= 0.10 * with.back().mean && without.back().sd <= 0.01 * without.back().mean;
    append_phrase(claim.ours,
                  fmt::format("{} {:.4f} of {:.2f} mm with, {:.4f} of {:.2f} mm without (at any step {:.4f}, "
                              "{:.4f})",
                              organ, with.back().sd, with.back().mean, without.back().sd, without.back().mean,
                              largest_sd(with), largest_sd(without)));
  }
  // Of n normal values; Ahn and Fessler 2003.
  append_phrase(claim.ours, fmt::format("{} runs, so each standard deviation is known to {:.0f} %", n_runs,
                                        100 / std::sqrt(2.0 * (n_runs - 1))));
  claim.verdict = to_verdict(holds);
  return claim;
}

ClaimVerdict frame_rate(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  ClaimVerdict claim{
      "frame_rate",
      "Frame rate at T005 and T007 sizes with about 70 outline and 30 friction-contact constraints, on a "
      "GPU",
      "14 per second (T005), 8 per second (T007)",
      fmt::format("node count within {:.0f} % of one of Table 1's, on average at least {:g} outline and "
                  "{:g} contact constraints a step; median rate of the full condition's nominal run at "
                  "least the paper's",
                  100 * table_one_tolerance, least_outline_constraints, least_contacts),
      "",
      ""};
  const auto timing =
      std::find_if(timings.begin(), timings.end(), [](const StepTiming &t) { return t.condition == full; });
  const RunQuality *run = nominal_run(evaluation, full);
  if (timing == timings.end() || !(timing->median_ms > 0) || !run)
    return not_assessed(claim, "the full condition's nominal run was not timed");
  const TableOneColumn *size = table_one_column(evaluation.n_registration_nodes());
  const double rate = 1000 / timing->median_ms;
  claim.ours =
      fmt::format("{:.0f} steps per second on a CPU (median {:.1f} ms, 95th percentile {:.1f} ms), {} nodes{}, "
                  "{:.0f} outline and {:.1f} contact constraints a step",
                  rate, timing->median_ms, timing->p95_ms, evaluation.n_registration_nodes(),
                  size ? fmt::format(" ({})", size->data_set) : "", run->mean_outline_constraints, run->mean_contacts);
  if (!size)
    return not_assessed(claim, claim.ours + fmt::format("; Table 1 has {} and {} nodes", table_one[0].n_nodes(),
                                                        table_one[1].n_nodes()));
  if (!(run->mean_outline_constraints >= least_outline_constraints && run->mean_contacts >= least_contacts))
    return not_assessed(claim,
                        claim.ours + "; the paper's step holds about 70 and 30, which registration_bench measures");
  claim.verdict = to_verdict(rate >= size->rate);
  return claim;
}
} // namespace pelvireg::runner
