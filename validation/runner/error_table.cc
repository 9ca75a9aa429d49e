#include "validation/runner/error_table.h"

#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/claims.h"

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

std::string header(const std::string &title)
{
  std::string line = fmt::format("{:<34}", title);
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

std::string surface_errors(const Evaluation &evaluation)
{
  std::string text = header("Mean surface error, mm") + mesh_difference(evaluation);
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
  return header("Motion of the truth, mm") + mean + "\n" + off_plane + "\n" +
         fmt::format("mean vaginal in-plane displacement {:.2f} mm\n", evaluation.vaginal_displacement);
}

std::string quality(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  std::string text;
  for (const std::string &condition : evaluation.conditions)
  {
    int n_failed = 0, n_steps = 0;
    double acceptance = 1, residual = 0;
    for (const RunQuality &run : evaluation.quality)
      if (run.condition == condition)
      {
        n_failed += run.n_failed_steps;
        n_steps += run.n_steps;
        acceptance = std::min(acceptance, run.least_acceptance);
        residual = std::max(residual, run.largest_mean_residual);
      }
    if (n_steps == 0)
      continue;
    text +=
        fmt::format("{}: {} of {} steps failed, control points accepted at least {:.1f} %, mean in-plane residual at "
                    "most {:.3f} mm\n",
                    condition, n_failed, n_steps, 100 * acceptance, residual);
  }
  for (const std::string &condition : evaluation.conditions)
  {
    double deepest = 0;
    for (const OrganPenetration &pair : evaluation.penetrations)
      if (pair.condition == condition && !pair.is_attached)
        deepest = std::max(deepest, pair.deepest);
    text +=
        fmt::format("{}: organs that are not attached reach at most {:.2f} mm into each other\n", condition, deepest);
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
  text += surface_errors(evaluation) + "\n" + motion(evaluation) + "\n" + quality(evaluation, timings) + "\n";
  for (const ClaimVerdict &claim : assess_claims(evaluation, timings))
    text += wrap(fmt::format("{:<14}{}: paper {}, ours {}", claim.verdict, claim.id, claim.paper, claim.ours), 14);
  return text;
}
} // namespace pelvireg::runner
