#include "validation/report/error_sections.h"

#include "validation/report/condition_order.h"
#include "validation/report/html.h"
#include "validation/runner/aggregate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

/// "–" where there is no value.
std::string millimetres(const std::optional<runner::Aggregate> &value, int digits)
{
  if (!value)
    return "–";
  return value->n_runs > 1 ? fmt::format("{:.{}f} ± {:.3f}", value->mean, digits, value->sd)
                           : fmt::format("{:.{}f}", value->mean, digits);
}

std::vector<std::string> organ_heading(const std::string &first)
{
  std::vector<std::string> heading = {first};
  heading.insert(heading.end(), organ_names.begin(), organ_names.end());
  return heading;
}
} // namespace

std::string verdict_mark(const std::string &verdict)
{
  const bool holds = verdict == "confirmed" || verdict == "met", fails = verdict == "refuted" || verdict == "missed";
  const std::string sign = holds ? "✓" : fails ? "✗" : "–";
  const std::string style = holds ? "yes" : fails ? "no" : "open";
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", style, sign, escape(verdict));
}

std::string verdict_sentence(const std::vector<runner::ClaimVerdict> &claims)
{
  const auto count = [&](const std::string &verdict)
  {
    return std::count_if(claims.begin(), claims.end(),
                         [&](const runner::ClaimVerdict &claim) { return claim.verdict == verdict; });
  };
  return fmt::format(
      "<p class=\"lead\">Of the paper's {} claims, on this case: <span class=\"verdict yes\">{} "
      "confirmed</span> <span class=\"verdict no\">{} refuted</span> <span class=\"verdict open\">{} not "
      "assessed</span></p>\n",
      claims.size(), count("confirmed"), count("refuted"), count("not assessed"));
}

namespace
{
std::vector<std::vector<std::string>> error_rows(const runner::Evaluation &evaluation, const std::string &condition)
{
  std::vector<std::string> last = {condition + ", last step"}, largest = {condition + ", largest over all steps"},
                           reduction = {condition + ", below unregistered, last step"};
  for (const std::string &organ : organ_names)
  {
    const auto by_step = runner::error_by_step(evaluation, condition, organ);
    const auto worst =
        std::max_element(by_step.begin(), by_step.end(), [](const auto &a, const auto &b) { return a.mean < b.mean; });
    const double nothing = runner::error_by_step(evaluation, runner::unregistered, organ).back().mean;
    last.push_back(millimetres(by_step.back(), 2));
    largest.push_back(millimetres(*worst, 2));
    reduction.push_back(nothing > 0 ? fmt::format("{:.0f} %", 100 * (1 - by_step.back().mean / nothing)) : "–");
  }
  if (condition == runner::unregistered)
    return {last, largest};
  return {last, largest, reduction};
}

/// What no registration can be held to: the truth's own error bar, and two meshes of one shape.
std::vector<std::vector<std::string>> floor_rows(const runner::Evaluation &evaluation, const dataset::Truth &truth)
{
  std::vector<std::vector<std::string>> rows = {{"the two meshes at rest, before any motion"}};
  for (const runner::OrganMotion &organ : evaluation.motion)
    rows.back().push_back(fmt::format("{:.2f}", organ.mesh_difference.mean));
  if (!truth.discretisation_error)
    return rows;
  const dataset::Points4 &mean = truth.discretisation_error->mean_by_organ;
  rows.push_back({"the truth's own error bar (displacement), mean"});
  for (Eigen::Index organ = 0; organ < mean.cols(); ++organ)
    rows.back().push_back(fmt::format("{:.2f}", mean(mean.rows() - 1, organ)));
  return rows;
}
} // namespace

std::string error_table_html(const runner::Evaluation &evaluation, const dataset::Truth &truth)
{
  const std::vector<std::string> heading =
      organ_heading(evaluation.is_inverse_crime ? "Mean surface error (mm), inverse crime" : "Mean surface error (mm)");
  std::vector<std::vector<std::string>> rows, others;
  for (const std::string &condition : reading_order(evaluation))
    for (const auto &row : error_rows(evaluation, condition))
      (is_main_condition(condition) ? rows : others).push_back(row);
  for (const auto &row : floor_rows(evaluation, truth))
    rows.push_back(row);
  return table(heading, rows) + (others.empty() ? "" : details("Other conditions", table(heading, others)));
}

std::string error_bar_sentence(const runner::Evaluation &evaluation, const dataset::Truth &truth)
{
  if (!truth.discretisation_error || !runner::has_condition(evaluation, "full"))
    return "";
  const dataset::Points4 &mean = truth.discretisation_error->mean_by_organ;
  std::string organs;
  for (std::size_t organ = 0; organ < organ_names.size(); ++organ)
    if (mean(mean.rows() - 1, static_cast<Eigen::Index>(organ)) >=
        runner::error_by_step(evaluation, "full", organ_names[organ]).back().mean)
      organs += (organs.empty() ? "" : ", ") + organ_names[organ];
  if (organs.empty())
    return "";
  return "<p>The truth's own error bar is not smaller than the error with all constraints for: <b>" + organs +
         "</b>. There the error is one against the motion of this mesh, not against the exact motion of the "
         "reference's model.</p>\n";
}

std::string claims_html(const std::vector<runner::ClaimVerdict> &claims)
{
  std::string html = "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">Verdict</th>"
                     "<th scope=\"col\">The paper's claim</th><th scope=\"col\">Paper</th><th scope=\"col\">Here</th>"
                     "<th scope=\"col\">Asked for</th></tr></thead><tbody>\n";
  for (const runner::ClaimVerdict &claim : claims)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td data-label=\"Paper\">{}</td><td data-label=\"Here\">{}</td>"
                        "<td data-label=\"Asked for\">{}</td></tr>\n",
                        verdict_mark(claim.verdict), escape(claim.claim), escape(claim.paper), escape(claim.ours),
                        escape(claim.criterion));
  return html + "</tbody></table></div>\n";
}

std::string aims_html(const std::vector<runner::Aim> &aims)
{
  std::string html = "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">Verdict</th>"
                     "<th scope=\"col\">Aim</th><th scope=\"col\">Here</th></tr></thead><tbody>\n";
  for (const runner::Aim &aim : aims)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td data-label=\"Here\">{}</td></tr>\n", verdict_mark(aim.verdict),
                        escape(aim.aim), escape(aim.ours));
  return html + "</tbody></table></div>\n";
}

namespace
{
using Values = std::vector<std::optional<runner::Aggregate>>;

/// A row a place of the curves, a column an organ; one table a condition.
std::string value_tables(const runner::Evaluation &evaluation, const std::string &first,
                         const std::function<Values(const std::string &, const std::string &)> &curve,
                         const std::function<std::string(std::size_t)> &label)
{
  const auto of_condition = [&](const std::string &condition)
  {
    std::vector<std::vector<std::string>> rows;
    for (const std::string &organ : organ_names)
    {
      const Values values = curve(condition, organ);
      rows.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        if (rows[i].empty())
          rows[i] = {label(i)};
        rows[i].push_back(millimetres(values[i], 3));
      }
    }
    return details("Values, " + condition, table(organ_heading(first), rows));
  };
  return by_condition(evaluation, of_condition, "Values, other conditions");
}
} // namespace

std::string step_tables_html(const runner::Evaluation &evaluation)
{
  const auto curve = [&](const std::string &condition, const std::string &organ)
  {
    const auto values = runner::error_by_step(evaluation, condition, organ);
    return Values(values.begin(), values.end());
  };
  return value_tables(evaluation, "step (mm)", curve, [](std::size_t i) { return std::to_string(i + 1); });
}

std::string slice_tables_html(const runner::Evaluation &evaluation)
{
  const auto curve = [&](const std::string &condition, const std::string &organ)
  { return runner::error_by_slice(evaluation, condition, organ); };
  const auto label = [&](std::size_t i)
  { return fmt::format("{:+d}", static_cast<int>(i) - evaluation.n_slices_each_side); };
  return value_tables(evaluation, "slice (mm)", curve, label);
}

std::string worst_places_html(const runner::Evaluation &evaluation, const std::vector<WorstPlace> &places)
{
  const auto of_condition = [&](const std::string &condition) -> std::string
  {
    std::vector<std::vector<std::string>> rows;
    for (const WorstPlace &place : places)
      if (place.condition == condition)
        rows.push_back(
            {place.organ, fmt::format("{:.2f}", place.error),
             fmt::format("{:.0f} {}", std::abs(place.offset), place.offset >= 0 ? "left" : "right"),
             fmt::format("{:.0f}, {:.0f}, {:.0f}", place.position.x(), place.position.y(), place.position.z())});
    if (rows.empty())
      return "";
    return "<div class=\"worst\" data-condition=\"" + escape(condition) + "\"><h3>" +
           escape(condition_title(condition)) + "</h3>" +
           table({"organ", "error (mm)", "from the image plane (mm)", "place, LPS (mm)"}, rows) + "</div>\n";
  };
  return "<div class=\"worst-grid\">\n" + by_condition(evaluation, of_condition) + "</div>\n";
}

std::string missed_html(const runner::Evaluation &evaluation)
{
  if (evaluation.missed_slices.empty())
    return "<p>Every slice that meets an organ of the truth meets the registered organ.</p>\n";
  std::vector<std::vector<std::string>> rows;
  for (const runner::MissedSlice &slice : evaluation.missed_slices)
    if (slice.sample == 0)
      rows.push_back(
          {slice.condition, slice.organ, std::to_string(slice.slice_index), fmt::format("{:.1f}", slice.truth_length)});
  return fmt::format("<p>Slices that meet an organ of the truth but not the registered one, over all runs: {}. No "
                     "distance exists there, they are missing from the curves. Those of the nominal runs:</p>\n",
                     evaluation.missed_slices.size()) +
         table({"Condition", "organ", "slice", "truth's contour (mm)"}, rows);
}

} // namespace pelvireg::report
