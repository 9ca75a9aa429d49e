#include "validation/report/summary_page.h"

#include "validation/report/condition_order.h"
#include "validation/report/error_sections.h"
#include "validation/report/figures.h"
#include "validation/report/html.h"
#include "validation/report/plane_overlays.h"
#include "validation/report/report_text.h"
#include "validation/report/run_sections.h"

#include <fmt/format.h>

namespace pelvireg::report
{
namespace
{
/// Sizes that put everything on one page.
const char *const style = R"(<style>
@page { size: A4; margin: 0; }
body { font-size: 8.6pt; line-height: 1.32; }
main { width: 210mm; max-width: none; margin: 0; padding: 8mm 12mm 5mm; display: flex; flex-direction: column; gap: 1.8mm; }
h1 { font-size: 14pt; margin: 0; }
h2 { font-size: 9.6pt; margin: 0 0 .5mm; }
p { margin: 0; max-width: none; }
.lead { font-size: 10.5pt; }
table, .facts { font-size: 7.4pt; }
.pair table { font-size: 6.9pt; }
.pair th, .pair td { padding: .35mm 1.2mm; }
td, tbody th { white-space: nowrap; }
.claims td { white-space: normal !important; }
th, td { padding: .35mm 1.6mm; }
.claims td, .claims th { min-width: 0 !important; font-size: 6.8pt; line-height: 1.25; }
.scroll, .panels, .facts { margin: 0; overflow: visible; }
.facts { max-width: none; padding: 1.5mm 3mm; display: grid; grid-template-columns: 10mm 24mm 40mm 30mm 1fr; gap: 0 3mm; }
.facts dt { font-size: 7pt; }
.facts div + div { margin: 0; }
.panels { display: grid; grid-template-columns: repeat(3, 53mm); gap: 0 10mm; justify-content: center; }
.legend svg { max-width: 75mm; }
.scroll table { width: 100%; }
details { display: none; }
.pair { display: grid; grid-template-columns: minmax(0, 1fr) 38mm; gap: 0 4mm; align-items: start; }
.low { font-size: 6.8pt; color: #39414a; }
.low p { margin-bottom: .8mm; overflow-wrap: anywhere; }
</style>
)";

std::string short_claims(const std::vector<runner::ClaimVerdict> &claims)
{
  std::string html = "<table class=\"claims\"><tbody>\n";
  for (const runner::ClaimVerdict &claim : claims)
    html += fmt::format("<tr><td>{}</td><td>{} <b>Paper:</b> {}. <b>Here:</b> {}.</td></tr>\n",
                        verdict_mark(claim.verdict), escape(claim.claim), escape(claim.paper), escape(claim.ours));
  return html + "</tbody></table>\n";
}

/// The panels of the paper's conditions; of others when none of those was run.
std::string row_of_panels(const std::vector<NamedPlot> &plots)
{
  std::string html;
  for (const NamedPlot &plot : plots)
    if (is_main_condition(plot.condition))
      html += "<figure>" + line_plot_svg(plot.plot) + "</figure>";
  return "<div class=\"panels\">" + html + "</div>\n";
}

/// The first condition's contours.
std::string image_plane(const ReportInputs &inputs)
{
  const auto overlays = plane_overlays(inputs, truth_surfaces(inputs.truth), nominal_surfaces(inputs));
  return "<figure>" + overlay_key_svg() + overlays.front().svg + "</figure>\n";
}

std::string notes(const ReportInputs &inputs)
{
  std::string html = "<div class=\"low\">";
  html += error_bar_sentence(inputs.evaluation, inputs.truth);
  html +=
      "<p><b>Surface error</b>: distance from fixed material points of the truth's outer surface to the closest "
      "triangle "
      "of the registered surface. <b>Slices</b> are parallel to the image plane (index 0), contours in the same plane. "
      "Bands and ±: standard deviation between runs.</p>"
      "<p><b>What this is not</b>: a comparison with a synthetic reference is verification, not clinical "
      "validation.</p>";
  for (const std::string &command : inputs.commands)
    html += "<p><b>Made by</b>: " + escape(command) + "</p>";
  if (!inputs.provenance.empty())
    html += "<p>" + escape(inputs.provenance.front().value) + "</p>";
  return html + "</div>\n";
}
} // namespace

std::string summary_page_html(const ReportInputs &inputs)
{
  const runner::Evaluation &evaluation = inputs.evaluation;
  const auto claims = runner::assess_claims(evaluation, inputs.timings);
  const std::string title = "Registration from one image plane: case " + evaluation.case_name;
  std::string html = page_head(title);
  html.insert(html.find("</head>"), style);
  html += "<h1>" + escape(title) + "</h1>\n";
  if (evaluation.is_inverse_crime)
    html += "<p><b>" + escape(runner::inverse_crime_notice(evaluation)) + "</b></p>\n";
  html += verdict_sentence(claims) + facts_html(evaluation) + "<div class=\"pair\">" +
          error_table_html(evaluation, inputs.truth) + image_plane(inputs) + "</div>\n" + short_claims(claims);
  html +=
      "<div><h2>Mean surface error by step, mean contour error by slice at the last step</h2><div class=\"legend\">" +
      legend_svg(dataset::organ_names) + "</div>" + row_of_panels(error_by_step_plots(evaluation)) +
      row_of_panels(error_by_slice_plots(evaluation)) + "</div>\n";
  return html + notes(inputs) + "</main></body></html>\n";
}
} // namespace pelvireg::report
