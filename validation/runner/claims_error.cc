// Claims on the surface error of single runs.
#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claim_terms.h"

#include <fmt/format.h>

#include <cmath>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

constexpr double small_motion_mm = 8.2; ///< the paper's mean vaginal in-plane displacement
constexpr double small_motion_tolerance_mm = 0.5;
constexpr double large_motion_mm = 25; ///< the paper's "above 2.5 cm"

double largest_vaginal_motion(const Evaluation &evaluation)
{
  for (const OrganMotion &motion : evaluation.motion)
    if (motion.organ == "vagina")
      return motion.max;
  return 0;
}

std::string ratio_phrase(double without, double with)
{
  return fmt::format("{:.2f} ({:.2f} / {:.2f} mm)", without / with, without, with);
}
} // namespace

bool is_large(const Evaluation &evaluation)
{
  return largest_vaginal_motion(evaluation) > large_motion_mm;
}

bool is_small(const Evaluation &evaluation)
{
  return std::abs(evaluation.vaginal_displacement - small_motion_mm) <= small_motion_tolerance_mm;
}

std::string motion_phrase(const Evaluation &evaluation)
{
  return fmt::format("the vagina moves {:.2f} mm in the plane on average and {:.2f} mm at most",
                     evaluation.vaginal_displacement, largest_vaginal_motion(evaluation));
}

ClaimVerdict better_than_unregistered(const Evaluation &evaluation)
{
  ClaimVerdict claim{"better_than_unregistered",
                     "Registration is far better than doing nothing, for every organ",
                     "far better",
                     "mean surface error at the last step at most half of unregistered, every organ",
                     "",
                     ""};
  if (!needs(evaluation, {full}, claim))
    return claim;
  bool holds = true;
  for (const std::string &organ : organ_names)
  {
    const double nothing = last_error(evaluation, unregistered, organ), error = last_error(evaluation, full, organ);
    holds = holds && error <= 0.5 * nothing;
    append_phrase(claim.ours, fmt::format("{} {:.2f} against {:.2f} mm", organ, error, nothing));
  }
  claim.verdict = to_verdict(holds);
  return claim;
}

ClaimVerdict below_four_mm(const Evaluation &evaluation)
{
  ClaimVerdict claim{"below_4_mm",
                     "Small motion (mean vaginal in-plane displacement 8.2 mm): mean surface error of every organ at "
                     "every step, all constraints on",
                     "< 4 mm",
                     "largest mean error of any run, organ and step below 4 mm",
                     "",
                     ""};
  if (!is_small(evaluation))
    return not_assessed(claim, motion_phrase(evaluation));
  if (!needs(evaluation, {full}, claim))
    return claim;
  const StepError *worst = nullptr;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == full && (!worst || row.distance.mean > worst->distance.mean))
      worst = &row;
  claim.ours =
      fmt::format("at most {:.2f} mm ({}, step {}, run {}); the vagina moves {:.2f} mm in the plane on average",
                  worst->distance.mean, worst->organ, worst->step, worst->sample, evaluation.vaginal_displacement);
  claim.verdict = to_verdict(worst->distance.mean < 4);
  return claim;
}

ClaimVerdict small_motion_ratio(const Evaluation &evaluation)
{
  ClaimVerdict claim{"vagina_ratio_small_motion",
                     "Small motion: the vagina's error without boundary conditions over the error with them",
                     "about 2",
                     "ratio at the last step at least 1.5 (three quarters of the paper's)",
                     "",
                     ""};
  if (!is_small(evaluation))
    return not_assessed(claim, motion_phrase(evaluation));
  if (!needs_sound(evaluation, {full, bare}, claim))
    return claim;
  const double with = last_error(evaluation, full, "vagina"), without = last_error(evaluation, bare, "vagina");
  claim.ours = ratio_phrase(without, with);
  claim.verdict = to_verdict(without >= 1.5 * with);
  return claim;
}

ClaimVerdict large_motion_ratio(const Evaluation &evaluation)
{
  ClaimVerdict claim{"ratio_large_motion",
                     "Large motion (vagina's maximum above 25 mm): error without boundary conditions over the error "
                     "with them, vagina and other organs",
                     "4 and 2",
                     "ratio at the last step at least 3 for the vagina and 1.5 for each other organ",
                     "",
                     ""};
  if (!is_large(evaluation))
    return not_assessed(claim, motion_phrase(evaluation));
  if (!needs_sound(evaluation, {full, bare}, claim))
    return claim;
  bool holds = true;
  for (const std::string &organ : organ_names)
  {
    const double with = last_error(evaluation, full, organ), without = last_error(evaluation, bare, organ);
    holds = holds && without >= (organ == "vagina" ? 3.0 : 1.5) * with;
    append_phrase(claim.ours, organ + " " + ratio_phrase(without, with));
  }
  append_phrase(claim.ours, motion_phrase(evaluation));
  claim.verdict = to_verdict(holds);
  return claim;
}
} // namespace pelvireg::runner
