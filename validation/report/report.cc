#include "validation/report/report.h"

#include "synthetic/dataset/geometry.h"
#include "validation/report/figures.h"
#include "validation/report/html.h"
#include "validation/report/report_text.h"
#include "validation/report/truth_text.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claims.h"
#include "validation/runner/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;

std::string millimetres(const runner::Aggregate &value)
{
  return value.n_runs > 1 ? fmt::format("{:.2f} ± {:.3f}", value.mean, value.sd) : fmt::format("{:.2f}", value.mean);
}

std::string error_table_html(const runner::Evaluation &evaluation)
{
  std::vector<std::string> heading = {evaluation.is_inverse_crime ? "Mean surface error (mm), inverse crime"
                                                                  : "Mean surface error (mm)"};
  heading.insert(heading.end(), organ_names.begin(), organ_names.end());
  std::vector<std::string> mesh_difference = {"meshes at rest, before any motion"};
  for (const runner::OrganMotion &organ : evaluation.motion)
    mesh_difference.push_back(fmt::format("{:.2f}", organ.mesh_difference.mean));
  std::vector<std::vector<std::string>> rows = {mesh_difference};
  for (const std::string &condition : evaluation.conditions)
  {
    std::vector<std::string> last = {condition + ", last step"}, largest = {condition + ", largest over all steps"},
                             reduction = {condition + ", below unregistered, last step"};
    for (const std::string &organ : organ_names)
    {
      const auto by_step = runner::error_by_step(evaluation, condition, organ);
      const auto worst = std::max_element(by_step.begin(), by_step.end(),
                                          [](const auto &a, const auto &b) { return a.mean < b.mean; });
      const double nothing = runner::error_by_step(evaluation, runner::unregistered, organ).back().mean;
      last.push_back(millimetres(by_step.back()));
      largest.push_back(millimetres(*worst));
      reduction.push_back(nothing > 0 ? fmt::format("{:.0f} %", 100 * (1 - by_step.back().mean / nothing)) : "–");
    }
    rows.push_back(last);
    rows.push_back(largest);
    if (condition != runner::unregistered)
      rows.push_back(reduction);
  }
  return table(heading, rows);
}

std::string verdict_mark(const std::string &verdict)
{
  const std::string sign = verdict == "confirmed" ? "✓" : verdict == "refuted" ? "✗" : "–";
  const std::string style = verdict == "confirmed" ? "yes" : verdict == "refuted" ? "no" : "open";
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", style, sign, escape(verdict));
}

std::string claims_html(const std::vector<runner::ClaimVerdict> &claims)
{
  std::string html = "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">Verdict</th>"
                     "<th scope=\"col\">The paper's claim</th><th scope=\"col\">Paper</th><th scope=\"col\">Ours</th>"
                     "<th scope=\"col\">What we ask for</th></tr></thead><tbody>\n";
  for (const runner::ClaimVerdict &claim : claims)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td data-label=\"Paper\">{}</td><td data-label=\"Ours\">{}</td>"
                        "<td data-label=\"We ask for\">{}</td></tr>\n",
                        verdict_mark(claim.verdict), escape(claim.claim), escape(claim.paper), escape(claim.ours),
                        escape(claim.criterion));
  return html + "</tbody></table></div>\n";
}

std::string verdict_sentence(const std::vector<runner::ClaimVerdict> &claims)
{
  const auto count = [&](const std::string &verdict)
  {
    return std::count_if(claims.begin(), claims.end(),
                         [&](const runner::ClaimVerdict &claim) { return claim.verdict == verdict; });
  };
  return fmt::format("<p class=\"lead\">Of the paper's {} claims, on this case: <b>{} confirmed, {} refuted, {} not "
                     "assessed</b>.</p>\n",
                     claims.size(), count("confirmed"), count("refuted"), count("not assessed"));
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
  for (const std::string &condition : evaluation.conditions)
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

std::string missed_html(const runner::Evaluation &evaluation)
{
  if (evaluation.missed_slices.empty())
    return "<p>Every slice that meets an organ of the truth meets the registered organ.</p>\n";
  std::vector<std::vector<std::string>> rows;
  for (const runner::MissedSlice &slice : evaluation.missed_slices)
    if (slice.sample == 0)
      rows.push_back(
          {slice.condition, slice.organ, std::to_string(slice.slice_index), fmt::format("{:.1f}", slice.truth_length)});
  return fmt::format(
             "<p>{} slices (all runs) meet an organ of the truth but not the registered one: no distance exists, "
             "they are missing from the curves. Those of the nominal run:</p>\n",
             evaluation.missed_slices.size()) +
         table({"Condition", "organ", "slice", "truth's contour (mm)"}, rows);
}

std::string pictures_html(const std::vector<ReportPicture> &pictures)
{
  std::string html;
  for (const ReportPicture &picture : pictures)
    if (const std::string url = png_data_url(picture.file); !url.empty())
      html += fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                          escape(picture.caption), url);
  return html.empty() ? "<p>No pictures were drawn.</p>\n" : "<div class=\"panels wide\">\n" + html + "</div>\n";
}

std::string provenance_html(const std::vector<ProvenanceEntry> &entries)
{
  std::vector<std::vector<std::string>> rows;
  for (const ProvenanceEntry &entry : entries)
    rows.push_back({entry.name, entry.value});
  return "<div class=\"provenance\">" + table({"Item", "Value"}, rows) + "</div>\n";
}
} // namespace

std::string report_html(const ReportInputs &inputs)
{
  const runner::Evaluation &evaluation = inputs.evaluation;
  const auto claims = runner::assess_claims(evaluation, inputs.timings);
  const std::string title = "Registration of pelvic organs from one image plane: case " + evaluation.case_name;
  std::string html = page_head(title);
  html += "<h1>" + escape(title) + "</h1>\n";
  if (evaluation.is_inverse_crime)
    html += "<p class=\"lead\"><b>" + escape(runner::inverse_crime_notice(evaluation)) + "</b></p>\n";
  html += verdict_sentence(claims) + error_table_html(evaluation);
  html += "<p>The paper's bound for every organ and step: below 4 mm. ± is the standard deviation between runs.</p>\n";
  html += "<h2>The paper's claims</h2>\n" + claims_html(claims);
  html += "<h2>Error by step</h2>\n" + error_by_step_figure(evaluation);
  html += "<h2>Error by slice at the last step</h2>\n" + error_by_slice_figure(evaluation) + missed_html(evaluation);
  html += "<h2>In the DYN plane at the last step</h2>\n<p>Seen from the left: anterior is left, superior is up.</p>\n" +
          plane_overlay_figure(inputs);
  html += "<h2>Pictures</h2>\n" + pictures_html(inputs.pictures);
  html += "<h2>What moved</h2>\n" + motion_html(evaluation);
  html += "<h2>How exact the truth is</h2>\n" + truth_quality_html(inputs.truth);
  html += "<h2>What the registration says of itself</h2>\n" + quality_html(evaluation, inputs.timings);
  html += definitions_html(evaluation) + limits_html();
  html += "<h2>Provenance</h2>\n" + provenance_html(inputs.provenance);
  return html + "</main></body></html>\n";
}

void write_report(const ReportInputs &inputs, const std::filesystem::path &file)
{
  runner::write_text_file(file, report_html(inputs));
}
} // namespace pelvireg::report
