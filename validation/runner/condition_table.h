// Every condition in one table, with what tells a real effect from a broken ablation.
#pragma once

#include "validation/runner/evaluate.h"

#include <string>

namespace pelvireg::runner
{
/// How well the runs of one condition follow the outlines that drive them, over all of its runs.
struct OutlineFit
{
  double residual = 0;   ///< mm, largest mean in-plane residual at a position's last step
  double acceptance = 1; ///< least share of accepted control points over the steps, 0 … 1
  int n_steps = 0, n_failed_steps = 0;

  /// Residual at most 0.3 mm, acceptance at least 90 %, no failed step: only then does the condition's error say
  /// something of what was taken away.
  bool is_followed() const;
};

OutlineFit outline_fit(const Evaluation &evaluation, const std::string &condition);

/// The mean surface error of every organ at the last step, one row a condition, its ratio to `full` and the in-plane
/// residual beside it. No ratio where the condition or `full` does not follow the outlines, or `full` was not judged.
std::string condition_table(const Evaluation &evaluation);
} // namespace pelvireg::runner
