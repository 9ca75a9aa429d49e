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

/// A slice counts for the growth of the error with the distance when its section of the truth's organ is at least this
/// share of the organ's largest one. Where a plane meets a surface at an angle a, a distance normal to the surface is
/// seen 1 / sin(a) times too large in the plane, without bound where the plane grazes the organ. On a ball the section
/// is proportional to sin^2(a), on a tube that lies along the plane to sin(a): from half of the largest section on, at
/// most twice as much is seen.
inline constexpr double least_section_share = 0.5;

/// Does the slice count? No for a slice whose section is not known.
bool counts_for_growth(const Evaluation &evaluation, const std::string &organ, int slice_index);

/// Growth of the mean contour error with the distance from the DYN plane.
struct Slope
{
  double value = 0;   ///< mm/mm, least squares
  int n_slices = 0;   ///< that it was fitted to
  int n_left_out = 0; ///< with an error that do not count
};

/// Over the slices that count, or over all of them. Nothing for fewer than two distances.
std::optional<Slope> slope_with_distance(const Evaluation &evaluation, const std::string &condition,
                                         const std::string &organ, bool all_slices = false);

/// One figure of StepMetrics, as it is called in metrics_by_step.csv and summary.json.
struct MetricFigure
{
  const char *name; ///< with its unit
  double (*value)(const StepMetrics &);
};

/// All of them, in the order of the columns.
const std::vector<MetricFigure> &metric_figures();

/// A figure at the last step over the runs. Nothing when the condition was not judged.
std::optional<Aggregate> metric_at_last_step(const Evaluation &evaluation, const std::string &condition,
                                             const std::string &organ, const MetricFigure &figure);

/// The same at the last step of every position, in order. Empty when the condition was not judged.
std::vector<Aggregate> metric_by_position(const Evaluation &evaluation, const std::string &condition,
                                          const std::string &organ, const MetricFigure &figure);

/// Surface and material-point error by slab at the last step, over the runs that have samples in it (all of one rest
/// shape do).
struct DistanceAggregate
{
  int bin = 0; ///< DistanceError::bin
  Aggregate surface, material;
};
std::vector<DistanceAggregate> error_by_distance(const Evaluation &evaluation, const std::string &condition,
                                                 const std::string &organ);

/// Was the condition judged?
bool has_condition(const Evaluation &evaluation, const std::string &condition);

/// Runs of the condition that the randomised aggregate counts (0 when only the nominal run is there).
int n_randomised_runs(const Evaluation &evaluation, const std::string &condition);
} // namespace pelvireg::runner
