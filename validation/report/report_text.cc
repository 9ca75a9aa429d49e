#include "validation/report/report_text.h"

#include "validation/report/html.h"

#include <fmt/format.h>

namespace pelvireg::report
{
namespace
{
const char *const style = R"(
body{margin:0;background:#fff;color:#1a1a1a;font:16px/1.5 system-ui,"Liberation Sans",sans-serif}
main{max-width:1240px;margin:0 auto;padding:16px 20px 60px}
h1{font-size:1.6rem;line-height:1.25;margin:.4em 0}
h2{font-size:1.25rem;margin:2em 0 .5em;border-bottom:1px solid #ccc;padding-bottom:.2em}
p,dl{max-width:75ch}
.lead{font-size:1.1rem}
.scroll{overflow-x:auto;margin:.6em 0}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.3em .7em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}
th:first-child{text-align:left}
tbody th{font-weight:400;min-width:9em}
thead th{border-bottom:2px solid #666}
.claims td,.claims th{text-align:left;min-width:9em}
.claims td:nth-child(2),.claims td:nth-child(4),.claims td:nth-child(5){min-width:15em}
.verdict{white-space:nowrap;font-weight:600;padding:.1em .5em;border-radius:4px}
.yes{background:#d6f0e4;color:#00513b}
.no{background:#fbdccb;color:#8a2f00}
.open{background:#eee;color:#444}
.panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,340px),1fr));gap:12px}
.panels.wide{grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr))}
.legend svg{width:100%;max-width:420px}
.key{margin:0}
.key svg{width:100%;max-width:560px}
figure{margin:0}
svg,img{display:block;width:100%;height:auto}
figcaption{font-size:.9rem;color:#333}
dt{font-weight:600;margin-top:.6em}
dd{margin:0 0 0 1.2em}
.provenance td{overflow-wrap:anywhere;text-align:left;min-width:12em}
@media(max-width:700px){
th,td{padding:.3em .4em}
.claims thead{display:none}
.claims tr{display:block;border-bottom:1px solid #999;padding:.6em 0}
.claims td{display:block;border:0;padding:.1em 0;min-width:0}
.claims td[data-label]:not([data-label=""])::before{content:attr(data-label) ": ";font-weight:600}
}
@media print{h2{break-after:avoid}figure{break-inside:avoid}}
)";

std::string definition(const std::string &term, const std::string &meaning)
{
  return "<dt>" + escape(term) + "</dt><dd>" + escape(meaning) + "</dd>\n";
}
std::string definitions_of_runs()
{
  std::string html;
  html += definition("Runs", "Sample 0 is the nominal run; in the others every Young's modulus is multiplied by "
                             "1 + 0.10 U(-1, 1) unless stated otherwise. Means and standard deviations are over the "
                             "randomised runs, or the nominal run alone when there are none.");
  html += definition("Acceptance", "Share of control points that found a compatible triangle, least over the steps.");
  html +=
      definition("In-plane residual", "Mean distance in the image plane that the accepted control points still have to "
                                      "their triangles after each position's last step, measured on a fresh matching.");
  html +=
      definition("Off-plane", "Component of the truth's displacement along the DYN plane's normal, absolute value.");
  html +=
      definition("Mean vaginal in-plane displacement", "Rest-arc-length mean of the in-plane displacement of the "
                                                       "vagina's outer contour in the DYN plane, by the judge's own "
                                                       "cut.");
  return html;
}
} // namespace

std::string page_head(const std::string &title)
{
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "img-src data:\">\n<title>" +
         escape(title) + "</title>\n<style>" + style + "</style></head>\n<body><main>\n";
}

std::string definitions_html(const runner::Evaluation &evaluation)
{
  const double spacing = evaluation.options.surface_spacing;
  std::string html = "<h2>Definitions</h2>\n<dl>\n";
  html +=
      definition("Surface error",
                 fmt::format("Fixed material points of the truth's rest outer surface, one per {:g} mm² ({:g} mm "
                             "spacing), are carried by the truth's displacement; each is measured to the closest "
                             "triangle of the registered outer surface. One-sided, as in the paper. Open ends (caps) "
                             "carry no point and are no target; the patch that vagina and uterus share is included.",
                             spacing * spacing, spacing));
  html += definition("Mean, p95, largest", "Over the points of one organ at one step: mean, 95th percentile (linear "
                                           "between order statistics), maximum; mm.");
  html +=
      definition("Contour error by slice",
                 fmt::format("Slice k lies k × {:g} mm from the DYN plane along its normal (positive to the left), "
                             "fixed in space. The judge cuts truth and estimate itself at the last step; the truth's "
                             "contour is sampled every {:g} mm of arc length, each point is measured to the closest "
                             "point of the estimate's contour in the same plane. Slices that miss the organ in the "
                             "truth have no value.",
                             evaluation.slice_pitch, evaluation.options.contour_spacing));
  html += definition("Step", fmt::format("{} registration steps; step s is compared with the truth's increment ⌈s/{}⌉.",
                                         evaluation.n_steps(), evaluation.steps_per_increment));
  html +=
      definition("Unregistered", "The registration's rest mesh against every increment: the error of doing nothing.");
  html += definition("Boundary conditions", "Ligaments, fasciae, contact and organ attachments. Without them only the "
                                            "image constraints are left.");
  return html + definitions_of_runs() + "</dl>\n";
}

std::string limits_html()
{
  return "<h2>What this is not</h2>\n<p>This compares a registration with a synthetic reference: verification by "
         "comparison. It is not a clinical validation. No patient's data are in it, the anatomy is parametric, and the "
         "true materials, loads and supports of a living pelvis are unknown. The reference is an independent "
         "finite-element model; its materials and supports were not tuned to the registration, only its load was "
         "calibrated, and only to the displacement that the paper states. The outlines that drive the registration are "
         "exact intersections: no image, no noise, no tracking error. A claim that failed is printed as refuted.</p>\n";
}
} // namespace pelvireg::report
