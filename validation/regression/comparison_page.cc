#include "validation/regression/comparison_page.h"

#include "validation/regression/comparison_text.h"
#include "validation/report/html.h"
#include "validation/report/line_plot.h"
#include "validation/report/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace pelvireg::regression
{
namespace
{
using report::escape;

std::string title_of(const FamilyComparison &family)
{
  return fmt::format("{}, {}, {}", family.name.condition, family.name.organ, curve_title(family));
}

report::LinePlot empty_plot(const FamilyComparison &family, const std::string &y_label)
{
  report::LinePlot plot;
  plot.title = title_of(family);
  plot.x_label = family.name.axis == Axis::step ? "registration step" : "slice index (0: DYN plane)";
  plot.y_label = y_label;
  plot.x_tick = family.name.axis == Axis::step ? 5 : 1;
  for (const ComparedPoint &point : family.points)
    plot.abscissae.push_back(point.abscissa);
  return plot;
}

/// Both curves; bands are the standard deviation between runs.
std::string curves_svg(const FamilyComparison &family)
{
  report::LinePlot plot = empty_plot(family, "mean error (mm)");
  report::Curve baseline{"baseline", {}, {}}, current{"current", {}, {}};
  double reach = 0;
  for (const ComparedPoint &point : family.points)
  {
    baseline.values.emplace_back(point.baseline);
    baseline.spreads.push_back(point.baseline_sd);
    current.values.emplace_back(point.current);
    current.spreads.push_back(point.current_sd);
    reach = std::max({reach, point.baseline + point.baseline_sd, point.current + point.current_sd});
  }
  plot.y_max = reach > 0 ? 1.05 * reach : 1;
  plot.curves = {baseline, current};
  return report::line_plot_svg(plot);
}

/// The logarithm of the ratio, which is the change in percent where that is small, and the band that holds all of it.
std::string ratio_svg(const FamilyComparison &family, const Rule &rule)
{
  report::LinePlot plot = empty_plot(family, "100 ln(current / baseline)");
  report::Curve ratio{"ratio", {}, {}};
  const double line = 100 * std::log(rule.local_line);
  double lowest = -line, highest = 1.4 * line;
  for (const ComparedPoint &point : family.points)
  {
    ratio.values.emplace_back(100 * std::log(point.ratio));
    ratio.spreads.push_back(50 * std::log(point.ratio_upper / point.ratio_lower));
    lowest = std::min(lowest, 105 * std::log(point.ratio_lower));
    highest = std::max(highest, 105 * std::log(point.ratio_upper));
  }
  plot.y_min = lowest;
  plot.y_max = highest;
  plot.curves = {{"", std::vector<std::optional<double>>(family.points.size()), {}}, ratio};
  plot.lines = {{0, "same"}, {line, fmt::format("the band may not lie above {:+.0f} %", 100 * (rule.local_line - 1))}};
  return report::line_plot_svg(plot);
}

std::string mark(Verdict verdict)
{
  const bool is_good = verdict == Verdict::pass || verdict == Verdict::improved;
  const char *style = is_good ? "yes" : verdict == Verdict::changed ? "open" : "no";
  const char *sign = is_good ? "✓" : verdict == Verdict::changed ? "–" : "✗";
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", style, sign, to_string(verdict));
}

const char *const style = R"(<style>
.gate td,.gate th{text-align:left}
.gate td:nth-child(3),.gate td:nth-child(4),.gate td:nth-child(5){white-space:nowrap}
.gate td:nth-child(6){min-width:16em}
.gate+p,.legend{margin-top:1em}
details summary{cursor:pointer;margin:1.5em 0 .5em;font-weight:600}
@media(max-width:700px){
.gate thead{display:none}
.gate tr{display:block;border-bottom:1px solid #999;padding:.6em 0}
.gate td{display:inline-block;border:0;padding:.1em .5em .1em 0;min-width:0}
.gate td[data-label]{display:block}
.gate td[data-label]::before{content:attr(data-label) ": ";font-weight:600}
}
</style>
)";

std::string row_html(const FamilyComparison &family)
{
  const bool has_curves = !family.points.empty();
  std::string html = fmt::format("<tr><td>{}</td><td>{}, {}, {}</td>", mark(family.verdict),
                                 escape(family.name.condition), escape(family.name.organ), curve_title(family));
  html += fmt::format("<td data-label=\"Baseline, current (mm)\">{}</td>",
                      has_curves ? fmt::format("{:.3f} → {:.3f}", family.baseline_mean, family.current_mean) : "–");
  html += fmt::format("<td data-label=\"Change\">{}</td><td data-label=\"99 % bounds (%)\">{}</td><td>{}</td></tr>\n",
                      change_text(family), bounds_text(family), escape(remarks_text(family)));
  return html;
}

std::string table_html(const Comparison &comparison)
{
  std::string html = "<div class=\"scroll\"><table class=\"gate\"><thead><tr>";
  for (const char *heading :
       {"Verdict", "Curves", "Baseline → current (mm)", "Change of E", "99 % bounds (%)", "Remarks"})
    html += fmt::format("<th scope=\"col\">{}</th>", heading);
  html += "</tr></thead><tbody>\n";
  for (const FamilyComparison *family : by_gravity(comparison))
    html += row_html(*family);
  return html + "</tbody></table></div>\n";
}

std::string figures_html(const Comparison &comparison, const Rule &rule, bool passed)
{
  std::string html;
  for (const FamilyComparison *entry : by_gravity(comparison))
    if (const FamilyComparison &family = *entry; !family.points.empty() && (family.verdict == Verdict::pass) == passed)
      html += fmt::format("<h3>{} {}</h3>\n<p>{}</p>\n<div class=\"panels\"><figure>{}</figure><figure>{}</figure>"
                          "</div>\n",
                          mark(family.verdict), escape(title_of(family)), escape(remarks_text(family)),
                          curves_svg(family), ratio_svg(family, rule));
  return html;
}

std::string rule_html(const Rule &rule)
{
  return fmt::format(
      "<p>E is the average of a curve over its steps or slices. <b>WORSE</b>: the mean ratio of E over the paired runs "
      "is "
      "not proven below {:.2f} and proven above 1; or the whole band lies above {:.2f} at some step or slice where the "
      "error grew by more than {:g} mm; or the largest 95th percentile grew likewise by {:.2f}; or the nominal run "
      "alone "
      "did; or a step failed that did not, or an organ left a slice; or condition full reaches {:g} mm. Each bound "
      "errs "
      "with probability {:g}. <b>CHANGED</b>: not worse, other numbers. <b>IMPROVED</b>: proven better by the same "
      "line. <b>INCOMPARABLE</b>, <b>MISSING</b>: nothing can be said, which is a failure. Bands left: standard "
      "deviation between runs. Bands right: they hold the true ratio at all places at once.</p>\n",
      rule.average_line, rule.local_line, rule.local_least_mm, rule.tail_line, rule.ceiling_mm, rule.level);
}
} // namespace

std::string comparison_page(const Comparison &comparison, const Rule &rule)
{
  const std::string title = "Error curves against their baseline: case " + comparison.case_name;
  const std::string summary = headline(comparison); // "VERDICT: the rest"
  std::string html = report::page_head(title);
  html.insert(std::min(html.find("</head>"), html.size()), style);
  html += "<h1>" + escape(title) + "</h1>\n<p class=\"lead\">" + mark(comparison.verdict()) + " " +
          escape(summary.substr(summary.find(':') + 2)) + "</p>\n";
  html += report::table({"", "from", "revision"},
                        {{"baseline", comparison.baseline_label,
                          comparison.baseline_revision + (comparison.has_anchor ? ", anchor" : "")},
                         {"current", comparison.current_label, comparison.current_revision},
                         {"randomised runs", std::to_string(comparison.n_runs), ""}});
  for (const std::string &problem : comparison.problems)
    html += "<p>" + mark(Verdict::incomparable) + " " + escape(problem) + "</p>\n";
  html += table_html(comparison) + rule_html(rule);
  html += "<div class=\"legend\" style=\"max-width:210px\">" + report::legend_svg({"baseline", "current"}) + "</div>\n";
  html += figures_html(comparison, rule, false);
  html += "<details><summary>Curves that pass</summary>\n" + figures_html(comparison, rule, true) + "</details>\n";
  return html + "</main></body></html>\n";
}
} // namespace pelvireg::regression
