#include "validation/runner/condition_table.h"

#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claims.h"

#include <fmt/format.h>

#include <algorithm>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

constexpr double largest_residual = 0.3; // mm
constexpr double least_acceptance = 0.9;
constexpr int name_column = 34, figure_column = 9, organ_column = 14;

std::string heading()
{
  std::string line = fmt::format("{:<{}}{:>{}}{:>{}}{:>{}}", "Mean surface error, last step, mm", name_column,
                                 "residual", figure_column, "accepted", figure_column, "failed", figure_column);
  for (const std::string &organ : organ_names)
    line += fmt::format("{:>{}}", organ, organ_column);
  return line + "\n";
}

double last_error(const Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  return error_by_step(evaluation, condition, organ).back().mean;
}

std::string row(const Evaluation &evaluation, const std::string &condition)
{
  const OutlineFit fit = outline_fit(evaluation, condition);
  const bool has_ratio = condition != "full" && has_condition(evaluation, "full") && fit.is_followed() &&
                         outline_fit(evaluation, "full").is_followed();
  std::string line = fmt::format("{:<{}}{:>{}.3f}{:>{}}{:>{}}", condition, name_column, fit.residual, figure_column,
                                 fmt::format("{:.1f} %", 100 * fit.acceptance), figure_column,
                                 fmt::format("{}/{}", fit.n_failed_steps, fit.n_steps), figure_column);
  for (const std::string &organ : organ_names)
  {
    const double error = last_error(evaluation, condition, organ);
    const double reference = has_ratio ? last_error(evaluation, "full", organ) : 0;
    const std::string ratio = reference > 0 ? fmt::format("x{:.2f}", error / reference) : "-";
    line += fmt::format("{:>{}}", fmt::format("{:.2f} {:>6}", error, condition == "full" ? "" : ratio), organ_column);
  }
  return line + (fit.is_followed() ? "\n" : "  does not follow its outlines\n");
}

std::string unregistered_row(const Evaluation &evaluation)
{
  std::string line = fmt::format("{:<{}}{:>{}}", unregistered, name_column, "", 3 * figure_column);
  for (const std::string &organ : organ_names)
    line += fmt::format("{:>{}}", fmt::format("{:.2f} {:>6}", last_error(evaluation, unregistered, organ), ""),
                        organ_column);
  return line + "\n";
}
} // namespace

bool OutlineFit::is_followed() const
{
  return residual <= largest_residual && acceptance >= least_acceptance && n_failed_steps == 0 && n_steps > 0;
}

OutlineFit outline_fit(const Evaluation &evaluation, const std::string &condition)
{
  OutlineFit fit;
  for (const RunQuality &run : evaluation.quality)
    if (run.condition == condition)
    {
      fit.residual = std::max(fit.residual, run.largest_mean_residual);
      fit.acceptance = std::min(fit.acceptance, run.least_acceptance);
      fit.n_steps += run.n_steps;
      fit.n_failed_steps += run.n_failed_steps;
    }
  return fit;
}

std::string condition_table(const Evaluation &evaluation)
{
  std::string text = fmt::format(
      "Conditions of case {}: error and its ratio to full. Residual: mean distance to the outlines in the\n"
      "image plane, mm; a ratio needs at most {} mm, {:.0f} % accepted control points and no failed step.\n\n",
      evaluation.case_name, largest_residual, 100 * least_acceptance);
  if (evaluation.is_inverse_crime)
    text += inverse_crime_notice(evaluation) + "\n\n";
  text += heading();
  for (const std::string &condition : evaluation.conditions)
    text += condition == unregistered ? unregistered_row(evaluation) : row(evaluation, condition);
  return text;
}
} // namespace pelvireg::runner
