#include "validation/runner/error_table.h"

#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/aims.h"
#include "validation/runner/claims.h"
#include "validation/runner/condition_table.h"
#include "validation/runner/node_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;

constexpr int column = 15;
constexpr std::size_t width = 110;

/// Break a line at spaces so that it stays within the width; later lines are indented. Ends with a newline.
std::string wrap(const std::string &line, std::size_t indent)
{
  std::string text, rest = line;
  while (rest.size() > width)
  {
    const std::size_t space = rest.rfind(' ', width);
    if (space == std::string::npos || space <= indent)
      break;
    text += rest.substr(0, space) + "\n";
    rest = std::string(indent, ' ') + rest.substr(space + 1);
  }
  return text + rest + "\n";
}

double largest(const std::vector<Aggregate> &by_step)
{
  double value = 0;
  for (const Aggregate &step : by_step)
    value = std::max(value, step.mean);
  return value;
}

/// Every block of figures carries the mark.
std::string header(const Evaluation &evaluation, const std::string &title)
{
  std::string line = evaluation.is_inverse_crime ? "[inverse crime: the registration made this truth]\n" : "";
  line += fmt::format("{:<34}", title);
  for (const std::string &organ : organ_names)
    line += fmt::format("{:>{}}", organ, column);
  return line + "\n";
}

std::string with_spread(const Aggregate &value)
{
  return value.n_runs > 1 ? fmt::format("{:.2f} +- {:.3f}", value.mean, value.sd) : fmt::format("{:.2f}", value.mean);
}

std::string mesh_difference(const Evaluation &evaluation)
{
  std::string line = fmt::format("{:<34}", "meshes at rest, before any motion");
  for (const OrganMotion &organ : evaluation.motion)
    line += fmt::format("{:>{}.2f}", organ.mesh_difference.mean, column);
  return line + "\n";
}

/// In the image plane, beside every condition's error: no ratio should come from a broken ablation.
std::string residual(const OutlineFit &fit)
{
  return fmt::format("{:>13.3f}{}", fit.residual, fit.is_followed() ? "" : " !");
}

std::string surface_errors(const Evaluation &evaluation)
{
  std::string text = header(evaluation, "Mean surface error, mm");
  text.back() = ' ';
  text += "residual, mm\n" + mesh_difference(evaluation);
  for (const std::string &condition : evaluation.conditions)
  {
    std::string last = fmt::format("{:<34}", condition + ", last step");
    std::string worst = fmt::format("{:<34}", "  largest over the steps");
    std::string reduction = fmt::format("{:<34}", "  below unregistered, last step, %");
    for (const std::string &organ : organ_names)
    {
      const auto by_step = error_by_step(evaluation, condition, organ);
      const double nothing = error_by_step(evaluation, unregistered, organ).back().mean;
      last += fmt::format("{:>{}}", with_spread(by_step.back()), column);
      worst += fmt::format("{:>{}.2f}", largest(by_step), column);
      reduction += nothing > 0 ? fmt::format("{:>{}.0f}", 100 * (1 - by_step.back().mean / nothing), column)
                               : fmt::format("{:>{}}", "-", column);
    }
    if (condition != unregistered)
      last += residual(outline_fit(evaluation, condition));
    text += last + "\n" + worst + "\n" + (condition == unregistered ? "" : reduction + "\n");
  }
  return text;
}

std::string motion(const Evaluation &evaluation)
{
  std::string mean = fmt::format("{:<34}", "mean / max"),
              off_plane = fmt::format("{:<34}", "off the plane, mean / max");
  for (const OrganMotion &organ : evaluation.motion)
  {
    mean += fmt::format("{:>{}}", fmt::format("{:.2f} / {:.2f}", organ.mean, organ.max), column);
    off_plane +=
        fmt::format("{:>{}}", fmt::format("{:.2f} / {:.2f}", organ.mean_off_plane, organ.max_off_plane), column);
  }
  return header(evaluation, "Motion of the truth, mm") + mean + "\n" + off_plane + "\n" +
         fmt::format("mean vaginal in-plane displacement {:.2f} mm\n", evaluation.vaginal_displacement);
}

struct MetricRow
{
  const char *title;
  const char *figure; ///< of metric_figures()
  int n_digits;
};
constexpr MetricRow metric_rows[] = {{"  material points, mm", "material_mean_mm", 2},
                                     {"    along the surface, mm", "tangential_mean_mm", 2},
                                     {"  symmetric, mm", "symmetric_mean_mm", 2},
                                     {"  95 % Hausdorff, mm", "hd95_mm", 2},
                                     {"  Dice", "dice", 3},
                                     {"  volume change, %", "volume_change_percent", 1},
                                     {"    of the truth, %", "truth_volume_change_percent", 1},
                                     {"  rotation error, rad", "rotation_error_rad", 3}};

std::string metrics_beyond(const Evaluation &evaluation)
{
  std::string text = header(evaluation, "Beyond surface distance, last step");
  for (const std::string &condition : evaluation.conditions)
  {
    text += condition + "\n";
    for (const MetricRow &row : metric_rows)
    {
      text += fmt::format("{:<34}", row.title);
      for (const MetricFigure &figure : metric_figures())
        if (figure.name == std::string(row.figure))
          for (const std::string &organ : organ_names)
          {
            const auto value = metric_at_last_step(evaluation, condition, organ, figure);
            text += value ? fmt::format("{:>{}.{}f}", value->mean, column, row.n_digits)
                          : fmt::format("{:>{}}", "-", column);
          }
      text += "\n";
    }
  }
  return text;
}

std::string elements(const Evaluation &evaluation, const std::string &condition)
{
  const BodyElements *worst = nullptr;
  int n_inverted = 0;
  for (const BodyElements &body : evaluation.elements)
    if (body.condition == condition)
    {
      n_inverted += body.jacobian.n_inverted;
      if (!worst || body.jacobian.smallest < worst->jacobian.smallest)
        worst = &body;
    }
  return worst ? fmt::format("{}: smallest element Jacobian {:.3f} ({}, run {}), {} inverted\n", condition,
                             worst->jacobian.smallest, worst->body, worst->sample, n_inverted)
               : "";
}

std::string quality(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  std::string text;
  for (const std::string &condition : evaluation.conditions)
  {
    const OutlineFit fit = outline_fit(evaluation, condition);
    if (fit.n_steps == 0)
      continue;
    text += wrap(fmt::format("{}: {} of {} steps failed, control points accepted at least {:.1f} %, mean in-plane "
                             "residual at most {:.3f} mm{}",
                             condition, fit.n_failed_steps, fit.n_steps, 100 * fit.acceptance, fit.residual,
                             fit.is_followed() ? "" : " (! does not follow the image: it gives no ratio)"),
                 2) +
            elements(evaluation, condition);
  }
  for (const std::string &condition : evaluation.conditions)
  {
    double deepest = 0, volume = 0;
    for (const OrganPenetration &pair : evaluation.penetrations)
      if (pair.condition == condition && !pair.is_attached)
      {
        deepest = std::max(deepest, pair.deepest);
        volume = std::max(volume, pair.largest_volume);
      }
    text += fmt::format("{}: organs that are not attached reach at most {:.2f} mm and {:.0f} mm3 into each other\n",
                        condition, deepest, volume);
  }
  for (const StepTiming &timing : timings)
    text += fmt::format("{}: median {:.2f} ms a step, 95th percentile {:.2f} ms\n", timing.condition, timing.median_ms,
                        timing.p95_ms);
  return text;
}
} // namespace

std::string error_table(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  std::string text = fmt::format("Case {}, {} steps. The paper's bound: < 4 mm at every step.\n\n",
                                 evaluation.case_name, evaluation.n_steps());
  if (evaluation.is_inverse_crime)
    text += wrap(inverse_crime_notice(evaluation), 0) + "\n";
  text += surface_errors(evaluation) + "\n" + metrics_beyond(evaluation) + "\n" + motion(evaluation) + "\n" +
          node_table(evaluation.registration_nodes) + "\n" + quality(evaluation, timings) + "\n";
  for (const ClaimVerdict &claim : assess_claims(evaluation, timings))
    text += wrap(fmt::format("{:<14}{}: paper {}, ours {}", claim.verdict, claim.id, claim.paper, claim.ours), 14);
  text += "\n";
  for (const Aim &aim : assess_aims(evaluation))
    text += wrap(fmt::format("{:<14}{}: {}, ours {}", aim.verdict, aim.id, aim.aim, aim.ours), 14);
  return text;
}
} // namespace pelvireg::runner
