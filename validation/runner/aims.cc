#include "validation/runner/aims.h"

#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claim_terms.h"

#include <fmt/format.h>

namespace pelvireg::runner
{
namespace
{
constexpr double small_error_mm = 1.5, large_error_mm = 3.0;
constexpr double left_of_unregistered = 0.40;
constexpr double small_ratio = 2, large_ratio = 4;

Aim not_assessed(Aim aim, const std::string &reason)
{
  aim.ours = reason;
  aim.verdict = "not assessed";
  return aim;
}

std::string met(bool holds)
{
  return holds ? "met" : "missed";
}

Aim error_at_every_step(const Evaluation &evaluation)
{
  const bool large = is_large(evaluation);
  const double bound = large ? large_error_mm : small_error_mm;
  Aim aim{"aim_error", fmt::format("mean surface error of every organ at every step at most {:.1f} mm", bound), "", ""};
  if (!large && !is_small(evaluation))
    return not_assessed(aim, motion_phrase(evaluation));
  if (!has_condition(evaluation, full))
    return not_assessed(aim, "condition 'full' was not run");
  bool holds = true;
  for (const std::string &organ : dataset::organ_names)
  {
    double worst = 0;
    for (const Aggregate &step : error_by_step(evaluation, full, organ))
      worst = step.mean > worst ? step.mean : worst;
    holds = holds && worst <= bound;
    append_phrase(aim.ours, fmt::format("{} {:.2f} mm", organ, worst));
  }
  aim.verdict = met(holds);
  return aim;
}

Aim below_unregistered(const Evaluation &evaluation)
{
  Aim aim{"aim_reduction",
          fmt::format("vagina and bladder at least {:.0f} % below unregistered at the last step",
                      100 * (1 - left_of_unregistered)),
          "", ""};
  if (!has_condition(evaluation, full))
    return not_assessed(aim, "condition 'full' was not run");
  bool holds = true;
  for (const std::string organ : {"vagina", "bladder"})
  {
    const double nothing = last_error(evaluation, unregistered, organ), error = last_error(evaluation, full, organ);
    holds = holds && error <= left_of_unregistered * nothing;
    append_phrase(aim.ours, fmt::format("{} {:.0f} %", organ, 100 * (1 - error / nothing)));
  }
  aim.verdict = met(holds);
  return aim;
}

Aim gain_of_boundary_conditions(const Evaluation &evaluation)
{
  const bool large = is_large(evaluation);
  const double bound = large ? large_ratio : small_ratio;
  Aim aim{"aim_ratio",
          fmt::format("vagina's error without boundary conditions at least {:g} times that with them", bound), "", ""};
  if (!large && !is_small(evaluation))
    return not_assessed(aim, motion_phrase(evaluation));
  ClaimVerdict soundness;
  if (!needs_sound(evaluation, {full, bare}, soundness))
    return not_assessed(aim, soundness.ours);
  const double with = last_error(evaluation, full, "vagina"), without = last_error(evaluation, bare, "vagina");
  aim.ours = fmt::format("{:.2f}", without / with);
  aim.verdict = met(without >= bound * with);
  return aim;
}
} // namespace

std::vector<Aim> assess_aims(const Evaluation &evaluation)
{
  std::vector<Aim> aims = {error_at_every_step(evaluation), below_unregistered(evaluation),
                           gain_of_boundary_conditions(evaluation)};
  if (evaluation.is_inverse_crime)
    for (Aim &aim : aims)
      aim.ours = "[inverse crime] " + aim.ours;
  return aims;
}
} // namespace pelvireg::runner
