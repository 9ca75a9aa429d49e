#include "validation/report/time_section.h"

#include "validation/report/condition_order.h"
#include "validation/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace pelvireg::report
{
namespace
{
/// One row with a bar behind its figures. `share` of the bar's room is filled, 0 to 1; none: no bar.
struct BarRow
{
  std::string name;
  std::vector<std::string> figures;
  std::optional<double> share;
};

std::string bar_table(const std::vector<std::string> &heading, const std::vector<BarRow> &rows)
{
  std::string html = "<div class=\"scroll\"><table class=\"bars\"><thead><tr>";
  for (const std::string &cell : heading)
    html += "<th scope=\"col\">" + escape(cell) + "</th>";
  html += "<th scope=\"col\"></th></tr></thead><tbody>\n";
  for (const BarRow &row : rows)
  {
    html += "<tr><th scope=\"row\">" + escape(row.name) + "</th>";
    for (const std::string &figure : row.figures)
      html += "<td>" + escape(figure) + "</td>";
    html += "<td>";
    if (row.share)
      html += fmt::format("<svg viewBox=\"0 0 100 6\" preserveAspectRatio=\"none\" aria-hidden=\"true\"><rect "
                          "width=\"{:.2f}\" height=\"6\"/></svg>",
                          100 * *row.share);
    html += "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string stages_html(const std::vector<StageTime> &stages)
{
  double longest = 0, total = 0;
  for (const StageTime &stage : stages)
  {
    longest = std::max(longest, stage.seconds);
    total += stage.seconds;
  }
  if (!(longest > 0))
    return "";
  std::vector<BarRow> rows;
  for (const StageTime &stage : stages)
    rows.push_back({stage.name, {fmt::format("{:.1f}", stage.seconds)}, stage.seconds / longest});
  rows.push_back({"all", {fmt::format("{:.1f}", total)}, {}});
  return bar_table({"Stage", "seconds"}, rows);
}

std::string steps_html(const std::vector<runner::StepTiming> &timings)
{
  std::vector<std::vector<std::string>> rows;
  for (const runner::StepTiming &timing : timings)
    rows.push_back({timing.condition, std::to_string(timing.n_steps), fmt::format("{:.1f}", timing.median_ms),
                    fmt::format("{:.1f}", timing.p95_ms), fmt::format("{:.1f}", timing.max_ms),
                    timing.median_ms > 0 ? fmt::format("{:.0f}", 1000 / timing.median_ms) : "–"});
  return table({"One step of the registration, nominal run", "steps", "median (ms)", "95th percentile (ms)",
                "longest (ms)", "steps a second"},
               rows);
}

std::string phase_table(const runner::StepTiming &timing)
{
  std::vector<BarRow> rows;
  const auto add = [&](const std::string &name, double mean_ms, bool has_bar)
  {
    const double share = timing.mean_ms > 0 ? mean_ms / timing.mean_ms : 0;
    rows.push_back({name,
                    {fmt::format("{:.2f}", mean_ms), fmt::format("{:.1f}", 100 * share)},
                    has_bar ? std::optional(share) : std::nullopt});
  };
  for (const runner::PhaseTiming &phase : timing.phases)
    add(runner::phase_title(phase.name), phase.mean_ms, true);
  add("whole step", timing.mean_ms, false);
  return bar_table({timing.condition, "mean (ms)", "share (%)"}, rows);
}

/// The phases of every condition, those that are not the paper's closed.
std::string phases_html(const std::vector<runner::StepTiming> &timings)
{
  std::string seen, closed, missing;
  for (const runner::StepTiming &timing : timings)
    if (timing.phases.empty())
      missing += (missing.empty() ? "" : ", ") + timing.condition;
    else
      (is_main_condition(timing.condition) ? seen : closed) += "<div>" + phase_table(timing) + "</div>\n";
  std::string html = "<h3>Phases of a step</h3>\n";
  if (!missing.empty())
    html += "<p>Not recorded for: " + escape(missing) + ".</p>\n";
  if (seen.empty() && closed.empty())
    return html;
  html += "<p>Mean over the steps of the nominal run, in the order of a step: wall time on the machine that played it, "
          "beside whatever else it did; with <code>--jobs</code> above 1 that can be other runs.</p>\n";
  const auto panels = [](const std::string &tables)
  { return "<div class=\"panels wide phases\">\n" + tables + "</div>\n"; };
  return html + (seen.empty() ? "" : panels(seen)) +
         (closed.empty() ? "" : details("Phases in other conditions", panels(closed)));
}
} // namespace

std::string time_html(const std::vector<StageTime> &stages, const std::vector<runner::StepTiming> &timings)
{
  if (timings.empty())
    return stages_html(stages) + "<p>The registration's steps were not timed.</p>\n";
  return stages_html(stages) + steps_html(timings) + phases_html(timings);
}
} // namespace pelvireg::report
