#include "validation/runner/aggregate.h"

#include "validation/metrics/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

namespace pelvireg::runner
{
namespace
{
Aggregate aggregate_of(const std::vector<double> &run_means)
{
  const metrics::Statistics statistics = metrics::describe(run_means);
  return {statistics.n, statistics.mean, statistics.sd, statistics.max};
}

/// Does a run count: a randomised one, or the nominal one when there is no other?
bool counts(const Evaluation &evaluation, const std::string &condition, int sample)
{
  return (sample > 0) == (n_randomised_runs(evaluation, condition) > 0);
}
} // namespace

bool has_condition(const Evaluation &evaluation, const std::string &condition)
{
  return std::find(evaluation.conditions.begin(), evaluation.conditions.end(), condition) !=
         evaluation.conditions.end();
}

int n_randomised_runs(const Evaluation &evaluation, const std::string &condition)
{
  return static_cast<int>(std::count_if(evaluation.quality.begin(), evaluation.quality.end(),
                                        [&](const RunQuality &run)
                                        { return run.condition == condition && run.sample > 0; }));
}

std::vector<Aggregate> error_by_step(const Evaluation &evaluation, const std::string &condition,
                                     const std::string &organ)
{
  std::map<int, std::vector<double>> means;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == condition && row.organ == organ && counts(evaluation, condition, row.sample))
      means[row.step].push_back(row.distance.mean);
  std::vector<Aggregate> aggregates;
  for (const auto &[step, run_means] : means)
    aggregates.push_back(aggregate_of(run_means));
  return aggregates;
}

std::vector<std::optional<Aggregate>> error_by_slice(const Evaluation &evaluation, const std::string &condition,
                                                     const std::string &organ)
{
  std::map<int, std::vector<double>> means;
  for (const SliceError &row : evaluation.by_slice)
    if (row.condition == condition && row.organ == organ && counts(evaluation, condition, row.sample))
      means[row.slice_index].push_back(row.distance.mean);
  std::vector<std::optional<Aggregate>> aggregates;
  for (int k = -evaluation.n_slices_each_side; k <= evaluation.n_slices_each_side; ++k)
    aggregates.push_back(means.contains(k) ? std::optional(aggregate_of(means[k])) : std::nullopt);
  return aggregates;
}

std::optional<double> slope_with_distance(const Evaluation &evaluation, const std::string &condition,
                                          const std::string &organ)
{
  const auto errors = error_by_slice(evaluation, condition, organ);
  std::vector<double> distances, values;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i])
    {
      distances.push_back(std::abs(static_cast<int>(i) - evaluation.n_slices_each_side) * evaluation.slice_pitch);
      values.push_back(errors[i]->mean);
    }
  if (std::set<double>(distances.begin(), distances.end()).size() < 2)
    return std::nullopt;
  const double mean_distance = metrics::describe(distances).mean;
  const double mean_value = metrics::describe(values).mean;
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
  {
    covariance += (distances[i] - mean_distance) * (values[i] - mean_value);
    variance += (distances[i] - mean_distance) * (distances[i] - mean_distance);
  }
  return covariance / variance;
}
} // namespace pelvireg::runner
