#include "validation/report/report.h"

#include "validation/report/error_sections.h"
#include "validation/report/figures.h"
#include "validation/report/html.h"
#include "validation/report/metric_sections.h"
#include "validation/report/plane_overlays.h"
#include "validation/report/report_data.h"
#include "validation/report/report_text.h"
#include "validation/report/run_sections.h"
#include "validation/report/time_section.h"
#include "validation/report/truth_text.h"
#include "validation/report/web_bundle.h"
#include "validation/runner/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
namespace
{
std::string pictures_html(const std::vector<ReportPicture> &pictures)
{
  std::string html;
  for (const ReportPicture &picture : pictures)
    if (const std::string url = jpeg_data_url(picture.jpeg); !url.empty())
      html += fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                          escape(picture.caption), url);
  return html.empty() ? "<p>No pictures were drawn.</p>\n" : "<div class=\"panels wide\">\n" + html + "</div>\n";
}

/// Frames, contour errors, and what tracking costs the registration.
std::string tracking_html(const TrackingResult &tracking)
{
  const auto figure = [](const std::string &caption, const std::string &url)
  {
    return fmt::format("<figure><img class=\"sheet\" alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                       escape(caption), url);
  };
  const auto table_of = [](const std::string &text) { return "<pre class=\"table\">" + escape(text) + "</pre>\n"; };
  std::string html = "<p>The organs were also followed through dynamic MR images rendered from the truth, from the "
                     "rest outline on. Conditions that end in “images” were driven by the tracked outlines.</p>\n";
  if (const std::string url = jpeg_data_url(tracking.frames_jpeg); !url.empty())
    html += figure("Dynamic images at rest, after a third and two thirds of the motion and at its end, with tracked "
                   "(solid) and true (dashed) outlines.",
                   url);
  html += table_of(tracking.contour_table);
  if (!tracking.cost_table.empty())
    html += table_of(tracking.cost_table);
  return html + figure("Mean distance of the tracked outlines from the true ones, by organ and frame.",
                       svg_data_url(tracking.error_figure));
}

/// A figure that the script replaces by a chart; `name` is the chart's.
std::string chart(const std::string &name, const std::string &still)
{
  return "<div class=\"chart\" data-chart=\"" + name + "\">\n<div class=\"still\">\n" + still + "</div></div>\n";
}

/// The first of the paper's conditions that was registered, as place in `conditions`.
std::size_t shown_condition(const std::vector<ConditionSurfaces> &conditions)
{
  for (const std::string name : {"full", "no_boundary_conditions"})
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (conditions[i].condition == name)
        return i;
  return conditions.empty() ? 0 : conditions.size() - 1;
}

struct Contents
{
  const ReportInputs &inputs;
  std::vector<runner::ClaimVerdict> claims;
  std::vector<MovingSurface> truth;
  std::vector<ConditionSurfaces> conditions;
  SliceDrawing slices;
  std::vector<WorstPlace> worst;
};

std::string error_sections(const Contents &contents)
{
  const runner::Evaluation &evaluation = contents.inputs.evaluation;
  std::string html = section("claims", "The paper's claims", claims_html(contents.claims));
  html += section("aims", "Aims of this project", aims_html(runner::assess_aims(evaluation)));
  html += section("by-step", "Error by step",
                  chart("step", panels_html(error_by_step_plots(evaluation))) + step_tables_html(evaluation));
  html += section("by-slice", "Error by slice at the last step",
                  chart("slice", panels_html(error_by_slice_plots(evaluation))) + slice_tables_html(evaluation) +
                      missed_html(evaluation));
  return html;
}

std::string space_sections(const Contents &contents)
{
  const ReportInputs &inputs = contents.inputs;
  const std::size_t shown = shown_condition(contents.conditions);
  const std::string name = shown < contents.conditions.size() ? contents.conditions[shown].condition : "none";
  std::string html =
      section("space", "In three dimensions",
              "<div id=\"viewer\"></div>\n<div id=\"pictures\">\n" + pictures_html(inputs.pictures) + "</div>\n");
  html += section("slices", "Slices at the last step",
                  "<p>Cut by the judge's own slicer, seen from the left: anterior is left, superior is up.</p>\n"
                  "<div id=\"slice-view\"></div>\n" +
                      slices_figure(contents.slices, shown, name, inputs.evaluation.slice_pitch) +
                      "<h3>In the image plane, by condition</h3>\n" +
                      plane_overlay_figure(plane_overlays(inputs, contents.truth, contents.conditions)));
  html += section("worst", "Worst places",
                  "<p>Of each condition's nominal run, the five worst of the judge's surface samples at the last step "
                  "that are at least 10 mm apart.</p>\n" +
                      worst_places_html(inputs.evaluation, contents.worst));
  if (inputs.tracking)
    html += section("tracking", "Tracked in images", tracking_html(*inputs.tracking));
  return html;
}

std::string further_sections(const Contents &contents)
{
  const ReportInputs &inputs = contents.inputs;
  const runner::Evaluation &evaluation = inputs.evaluation;
  std::string html = section("metrics", "What surface distance does not see",
                             "<p>At the last step, means over the runs. Definitions are below.</p>\n" +
                                 chart("metric", metrics_html(evaluation)));
  html += section("distance", "Error by distance from the image plane",
                  chart("distance", "") + distance_tables_html(evaluation));
  html += section("elements", "Elements and penetration",
                  "<p>Of all runs the worst. J is an element's volume over its volume at rest; 0 or less is turned "
                  "inside out.</p>\n" +
                      elements_html(evaluation) + penetrations_html(evaluation));
  html += section("motion", "What moved", motion_html(evaluation));
  html += section("truth", "How exact the truth is", truth_quality_html(inputs.truth));
  html += section("runs", "What the registration says of itself", quality_html(evaluation, inputs.timings));
  html += section("time", "Time", time_html(inputs.stages, inputs.timings));
  return html;
}

std::string footer(const ReportInputs &inputs)
{
  std::string html = section("definitions", "Definitions", definitions_html(inputs.evaluation));
  html += section("limits", "What this is not", limits_html(inputs.tracking.has_value()));
  html += section("provenance", "Provenance", provenance_html(inputs.provenance, inputs.commands));
  return html + "<footer>\n" +
         details("Licences of the libraries in this page",
                 "<pre>" + escape(std::string(page_licences())) + "</pre>\n") +
         "</footer>\n";
}
} // namespace

std::string report_html(const ReportInputs &inputs)
{
  const runner::Evaluation &evaluation = inputs.evaluation;
  Contents contents{inputs,
                    runner::assess_claims(evaluation, inputs.timings),
                    truth_surfaces(inputs.truth),
                    nominal_surfaces(inputs),
                    {},
                    {}};
  contents.slices = slice_drawing(inputs, contents.truth, contents.conditions);
  contents.worst = worst_places(inputs, contents.truth, contents.conditions);
  const std::string title = "Registration of pelvic organs from one image plane: case " + evaluation.case_name;
  std::string html = page_head(title, page_script_digest());
  html += "<h1>" + escape(title) + "</h1>\n";
  if (evaluation.is_inverse_crime)
    html += "<p class=\"lead\"><b>" + escape(runner::inverse_crime_notice(evaluation)) + "</b></p>\n";
  html += page_links() + verdict_sentence(contents.claims) + "<div class=\"first\">\n<div>" +
          error_table_html(evaluation, inputs.truth) +
          "<p>The paper's bound for every organ and step: below 4 mm. ± is the standard deviation between "
          "runs.</p>\n" +
          error_bar_sentence(evaluation, inputs.truth) + "</div>\n" + facts_html(evaluation) + "</div>\n";
  html += error_sections(contents) + space_sections(contents) + further_sections(contents) + footer(inputs);
  html += "</main>\n<script type=\"application/octet-stream\" id=\"data\">" +
          report_data(inputs, contents.truth, contents.conditions, contents.slices, contents.worst) + "</script>\n";
  return html + "<script>" + std::string(page_script()) + "</script>\n</body></html>\n";
}

void write_report(const ReportInputs &inputs, const std::filesystem::path &file)
{
  runner::write_text_file(file, report_html(inputs));
}
} // namespace pelvireg::report
