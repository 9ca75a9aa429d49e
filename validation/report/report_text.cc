#include "validation/report/report_text.h"

#include "validation/report/html.h"
#include "validation/report/web_bundle.h"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

namespace pelvireg::report
{
namespace
{
std::string definition(const std::string &term, const std::string &meaning)
{
  return "<dt>" + escape(term) + "</dt><dd>" + escape(meaning) + "</dd>\n";
}

std::string definitions_of_metrics(const runner::Evaluation &evaluation)
{
  std::string html;
  html +=
      definition("Material-point error",
                 "Length of the estimate's displacement minus the truth's, at the judge's surface samples; the point "
                 "of the estimate's rest surface closest to a sample at rest stands for it. Of unregistered it is the "
                 "truth's motion. Its parts along and across the truth's surface normal are averaged by length.");
  html +=
      definition("Symmetric distance, HD95",
                 "Mean of the distances of the truth's samples to the estimate and of the estimate's own samples to "
                 "the truth (ASSD); the larger of both directions' 95th percentiles.");
  html += definition("Dice", fmt::format("Twice the volume in common over the sum of both volumes, of what the closed "
                                         "outer surfaces enclose, lumen included, along lines {:g} mm apart.",
                                         evaluation.options.line_spacing));
  html += definition("Volume change", "Of what the closed outer surface encloses, against its own mesh at rest.");
  html += definition("Rotation error", "Angle of the rotation that best carries the estimate's material points to the "
                                       "truth's (Kabsch).");
  html += definition("Error by distance",
                     fmt::format("The truth's surface samples in slabs of {:g} mm parallel to the DYN plane, by where "
                                 "they are in the truth at the last step. No slab is missed and none weighs more "
                                 "because a plane grazes the organ.",
                                 evaluation.slice_pitch));
  html +=
      definition("The truth's own error bar",
                 "Grid convergence index of the truth's displacement by a study of the same case on three meshes, mean "
                 "over material points of an organ's outer surface away from bars, at the last increment.");
  html += definition("Penetration", "How deep a node or triangle's centroid of one organ lies inside another, and the "
                                    "volume inside both; the judge's own points, largest over the positions. Attached: "
                                    "the registration holds the two together, they meet by design.");
  html +=
      definition("Colours in the 3-D view",
                 "Of the truth's nodes the distance to the closest triangle of the estimate, of the estimate's nodes "
                 "the distance to the truth, at that step, in steps of 0.04 mm. Nodes are not the judge's samples: "
                 "their largest value can exceed the tables'.");
  return html;
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
  html += definition("Phases of a step",
                     "Matching of the outlines, with the rows of all constraints. Assembly of rotations, forces and "
                     "matrices. Factorisation (Cholesky). Free motion: what the organs would do without constraints. "
                     "Compliance W of the constraints. Constraint forces: the solve for them. Correction of the "
                     "positions by them. Residuals, on a fresh matching. Contact detection: what this step leaves is "
                     "what the next one starts from.");
  html +=
      definition("Off-plane", "Component of the truth's displacement along the DYN plane's normal, absolute value.");
  html +=
      definition("Mean vaginal in-plane displacement", "Rest-arc-length mean of the in-plane displacement of the "
                                                       "vagina's outer contour in the DYN plane, by the judge's own "
                                                       "cut.");
  return html;
}
} // namespace

std::string page_head(const std::string &title, std::string_view script_digest)
{
  std::string policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
  if (!script_digest.empty())
    policy += "; script-src 'sha256-" + std::string(script_digest) + "'";
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy + "\">\n<title>" + escape(title) + "</title>\n<style>" + std::string(page_style()) +
         "</style></head>\n<body><main>\n";
}

std::string page_links()
{
  std::string html = "<nav aria-label=\"Parts of this page\">";
  for (const auto &[id, name] :
       std::initializer_list<std::pair<const char *, const char *>>{{"claims", "Claims"},
                                                                    {"by-step", "By step"},
                                                                    {"by-slice", "By slice"},
                                                                    {"space", "3-D"},
                                                                    {"slices", "Slices"},
                                                                    {"worst", "Worst places"},
                                                                    {"metrics", "Metrics"},
                                                                    {"truth", "Truth"},
                                                                    {"time", "Time"},
                                                                    {"definitions", "Definitions"},
                                                                    {"provenance", "Provenance"}})
    html += fmt::format("<a href=\"#{}\">{}</a>", id, name);
  return html + "</nav>\n";
}

std::string definitions_html(const runner::Evaluation &evaluation)
{
  const double spacing = evaluation.options.surface_spacing;
  std::string html = "<dl>\n";
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
  return html + definitions_of_metrics(evaluation) + definitions_of_runs() + "</dl>\n";
}

std::string limits_html(bool has_tracked_outlines)
{
  const std::string outlines =
      has_tracked_outlines ? "The images are synthetic, as is the motion in them. "
                           : "The outlines that drive the registration are exact intersections: no image, no noise, no "
                             "tracking error. ";
  return "<p>This compares a registration with a synthetic reference: verification by "
         "comparison. It is not a clinical validation. No patient's data are in it, the anatomy is parametric, and the "
         "true materials, loads and supports of a living pelvis are unknown. The reference is an independent "
         "finite-element model; its materials and supports were not tuned to the registration, only its load was "
         "calibrated, and only to the displacement that the paper states. " +
         outlines + "A claim that failed is printed as refuted.</p>\n";
}
} // namespace pelvireg::report
