#include "validation/report/run_sections.h"

#include "validation/report/condition_order.h"
#include "validation/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pelvireg::report
{
namespace
{
/// "full, no_contact; each one nominal and 20 randomised runs", or with the number of each.
std::string runs_text(const runner::Evaluation &evaluation)
{
  std::map<std::string, int> randomised;
  for (const runner::RunQuality &run : evaluation.quality)
    randomised[run.condition] += run.sample > 0 ? 1 : 0;
  if (randomised.empty())
    return "none";
  const int first = randomised.begin()->second;
  const bool alike = std::all_of(randomised.begin(), randomised.end(),
                                 [&](const auto &condition) { return condition.second == first; });
  std::string text;
  for (const std::string &condition : reading_order(evaluation))
    if (randomised.contains(condition))
      text +=
          (text.empty() ? "" : ", ") + condition + (alike ? "" : fmt::format(" (1 + {} runs)", randomised[condition]));
  if (alike && first == 0)
    return text + "; the nominal run alone";
  return alike ? fmt::format("{}; one nominal and {} randomised runs{}", text, first,
                             randomised.size() > 1 ? " each" : "")
               : text;
}
} // namespace

std::string facts_html(const runner::Evaluation &evaluation)
{
  int n_failed = 0, n_steps = 0;
  for (const runner::RunQuality &run : evaluation.quality)
  {
    n_failed += run.n_failed_steps;
    n_steps += run.n_steps;
  }
  const auto fact = [](const std::string &name, const std::string &value)
  { return "<div><dt>" + name + "</dt><dd>" + escape(value) + "</dd></div>\n"; };
  return "<dl class=\"facts\">\n" + fact("Case", evaluation.case_name) + fact("Truth", evaluation.truth_source) +
         fact("Motion", fmt::format("{} increments; the vagina moves {:.2f} mm in the image plane on average",
                                    evaluation.n_increments, evaluation.vaginal_displacement)) +
         fact("Registration", fmt::format("{} steps, {} nodes, {} of {} steps failed", evaluation.n_steps(),
                                          evaluation.n_registration_nodes(), n_failed, n_steps)) +
         fact("Conditions", runs_text(evaluation)) + "</dl>\n";
}

std::string motion_html(const runner::Evaluation &evaluation)
{
  std::vector<std::vector<std::string>> rows;
  for (const runner::OrganMotion &organ : evaluation.motion)
    rows.push_back({organ.organ, fmt::format("{:.2f}", organ.mean), fmt::format("{:.2f}", organ.max),
                    fmt::format("{:.2f}", organ.mean_off_plane), fmt::format("{:.2f}", organ.max_off_plane)});
  return table({"Truth at the last increment (mm)", "mean motion", "largest", "mean off-plane", "largest off-plane"},
               rows) +
         fmt::format("<p>Mean vaginal in-plane displacement: {:.2f} mm (the reference wrote {:.2f} mm). Source of the "
                     "truth: {}.</p>\n",
                     evaluation.vaginal_displacement, evaluation.reported_vaginal_displacement,
                     escape(evaluation.truth_source));
}

/// The worst figures of the runs of each condition.
std::string quality_html(const runner::Evaluation &evaluation, const std::vector<runner::StepTiming> &timings)
{
  std::vector<std::vector<std::string>> rows;
  for (const std::string &condition : reading_order(evaluation))
  {
    runner::RunQuality worst;
    worst.least_acceptance = 1;
    int n_runs = 0;
    for (const runner::RunQuality &run : evaluation.quality)
      if (run.condition == condition)
      {
        ++n_runs;
        worst.n_steps += run.n_steps;
        worst.n_failed_steps += run.n_failed_steps;
        worst.least_acceptance = std::min(worst.least_acceptance, run.least_acceptance);
        worst.largest_mean_residual = std::max(worst.largest_mean_residual, run.largest_mean_residual);
        worst.largest_out_of_plane_force = std::max(worst.largest_out_of_plane_force, run.largest_out_of_plane_force);
        worst.largest_in_plane_force = std::max(worst.largest_in_plane_force, run.largest_in_plane_force);
      }
    if (n_runs == 0)
      continue;
    std::string rate = "not measured";
    for (const runner::StepTiming &timing : timings)
      if (timing.condition == condition)
        rate = fmt::format("{:.1f} / {:.1f}", timing.median_ms, timing.p95_ms);
    rows.push_back(
        {condition, std::to_string(n_runs), fmt::format("{} of {}", worst.n_failed_steps, worst.n_steps),
         fmt::format("{:.1f}", 100 * worst.least_acceptance), fmt::format("{:.3f}", worst.largest_mean_residual),
         fmt::format("{:.1e} / {:.1e}", worst.largest_out_of_plane_force, worst.largest_in_plane_force), rate});
  }
  return rows.empty() ? "<p>Nothing was registered.</p>\n"
                      : table({"Condition", "runs", "failed steps", "least acceptance (%)",
                               "largest mean in-plane residual (mm)", "largest nodal force out of / in plane (N)",
                               "ms a step, median / 95th percentile"},
                              rows);
}

std::string provenance_html(const std::vector<ProvenanceEntry> &entries, const std::vector<std::string> &commands)
{
  std::string html;
  if (!commands.empty())
  {
    html = "<p>To make this result again:</p>\n<pre class=\"command\">";
    for (const std::string &command : commands)
      html += escape(command) + "\n";
    html += "</pre>\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const ProvenanceEntry &entry : entries)
    rows.push_back({entry.name, entry.value});
  return html + "<div class=\"provenance\">" + table({"Item", "Value"}, rows) + "</div>\n";
}
} // namespace pelvireg::report
