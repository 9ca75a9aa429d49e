// Figures over the runs of a condition.
#pragma once

#include "validation/runner/evaluate.h"

#include <optional>
#include <string>
#include <vector>

namespace pelvireg::runner
{
/// Over the randomised runs of a condition, or over the nominal run alone when there are none; mm.
struct Aggregate
{
  int n_runs = 0;
  double mean = 0; ///< of the runs' mean errors
  double sd = 0;   ///< sample standard deviation between runs; 0 for a single run
  double max = 0;  ///< largest of the runs' mean errors
};

/// Mean surface error at each step, index 0 is step 1. Empty when the condition was not judged.
std::vector<Aggregate> error_by_step(const Evaluation &evaluation, const std::string &condition,
                                     const std::string &organ);

/// Mean contour error at the last step in each slice, index 0 is slice -n_slices_each_side; nothing where a slice
/// misses the organ in the truth or in every run.
std::vector<std::optional<Aggregate>> error_by_slice(const Evaluation &evaluation, const std::string &condition,
                                                     const std::string &organ);

/// Least-squares slope of the mean contour error against the distance from the DYN plane, mm/mm. Nothing for fewer than
/// two distances.
std::optional<double> slope_with_distance(const Evaluation &evaluation, const std::string &condition,
                                          const std::string &organ);

/// Was the condition judged?
bool has_condition(const Evaluation &evaluation, const std::string &condition);

/// Runs of the condition that the randomised aggregate counts (0 when only the nominal run is there).
int n_randomised_runs(const Evaluation &evaluation, const std::string &condition);
} // namespace pelvireg::runner
