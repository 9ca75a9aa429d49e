#include "validation/runner/aggregate.h"

#include "validation/metrics/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

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
class CountedRuns
{
public:
  CountedRuns(const Evaluation &evaluation, const std::string &condition)
      : randomised_(n_randomised_runs(evaluation, condition) > 0)
  {
  }
  bool contain(int sample) const { return (sample > 0) == randomised_; }

private:
  bool randomised_;
};

double percent_change(double value, double rest)
{
  return 100 * (value / rest - 1);
}

/// Least-squares slope; nothing when all places are the same.
std::optional<double> fitted_slope(const std::vector<double> &places, const std::vector<double> &values)
{
  if (std::set<double>(places.begin(), places.end()).size() < 2)
    return std::nullopt;
  const double mean_place = metrics::describe(places).mean, mean_value = metrics::describe(values).mean;
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    covariance += (places[i] - mean_place) * (values[i] - mean_value);
    variance += (places[i] - mean_place) * (places[i] - mean_place);
  }
  return covariance / variance;
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
  const CountedRuns counted(evaluation, condition);
  std::map<int, std::vector<double>> means;
  for (const StepError &row : evaluation.by_step)
    if (row.condition == condition && row.organ == organ && counted.contain(row.sample))
      means[row.step].push_back(row.distance.mean);
  std::vector<Aggregate> aggregates;
  for (const auto &[step, run_means] : means)
    aggregates.push_back(aggregate_of(run_means));
  return aggregates;
}

std::vector<std::optional<Aggregate>> error_by_slice(const Evaluation &evaluation, const std::string &condition,
                                                     const std::string &organ)
{
  const CountedRuns counted(evaluation, condition);
  std::map<int, std::vector<double>> means;
  for (const SliceError &row : evaluation.by_slice)
    if (row.condition == condition && row.organ == organ && counted.contain(row.sample))
      means[row.slice_index].push_back(row.distance.mean);
  std::vector<std::optional<Aggregate>> aggregates;
  for (int k = -evaluation.n_slices_each_side; k <= evaluation.n_slices_each_side; ++k)
    aggregates.push_back(means.contains(k) ? std::optional(aggregate_of(means[k])) : std::nullopt);
  return aggregates;
}

bool counts_for_growth(const Evaluation &evaluation, const std::string &organ, int slice_index)
{
  return std::any_of(evaluation.sections.begin(), evaluation.sections.end(),
                     [&](const TruthSection &section) {
                       return section.organ == organ && section.slice_index == slice_index &&
                              section.share >= least_section_share;
                     });
}

std::optional<Slope> slope_with_distance(const Evaluation &evaluation, const std::string &condition,
                                         const std::string &organ, bool all_slices)
{
  const auto errors = error_by_slice(evaluation, condition, organ);
  std::vector<double> distances, values;
  Slope slope;
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    const int k = static_cast<int>(i) - evaluation.n_slices_each_side;
    if (!errors[i])
      continue;
    if (!all_slices && !counts_for_growth(evaluation, organ, k))
    {
      ++slope.n_left_out;
      continue;
    }
    distances.push_back(std::abs(k) * evaluation.slice_pitch);
    values.push_back(errors[i]->mean);
  }
  const auto fitted = fitted_slope(distances, values);
  if (!fitted)
    return std::nullopt;
  slope.value = *fitted;
  slope.n_slices = static_cast<int>(values.size());
  return slope;
}

const std::vector<MetricFigure> &metric_figures()
{
  static const std::vector<MetricFigure> figures = {
      {"material_mean_mm", [](const StepMetrics &m) { return m.material.distance.mean; }},
      {"material_p95_mm", [](const StepMetrics &m) { return m.material.distance.p95; }},
      {"material_max_mm", [](const StepMetrics &m) { return m.material.distance.max; }},
      {"normal_mean_mm", [](const StepMetrics &m) { return m.material.normal_mean; }},
      {"tangential_mean_mm", [](const StepMetrics &m) { return m.material.tangential_mean; }},
      {"symmetric_mean_mm", [](const StepMetrics &m) { return m.symmetric.mean; }},
      {"hd95_mm", [](const StepMetrics &m) { return m.symmetric.hd95; }},
      {"dice", [](const StepMetrics &m) { return m.dice; }},
      {"volume_mm3", [](const StepMetrics &m) { return m.volume; }},
      {"volume_change_percent", [](const StepMetrics &m) { return percent_change(m.volume, m.rest_volume); }},
      {"truth_volume_mm3", [](const StepMetrics &m) { return m.truth_volume; }},
      {"truth_volume_change_percent",
       [](const StepMetrics &m) { return percent_change(m.truth_volume, m.truth_rest_volume); }},
      {"rotation_error_rad", [](const StepMetrics &m) { return m.rotation_error; }},
      {"truth_rotation_rad", [](const StepMetrics &m) { return m.truth_rotation; }}};
  return figures;
}

std::vector<Aggregate> metric_by_position(const Evaluation &evaluation, const std::string &condition,
                                          const std::string &organ, const MetricFigure &figure)
{
  const CountedRuns counted(evaluation, condition);
  std::map<int, std::vector<double>> values;
  for (const StepMetrics &row : evaluation.metrics_by_step)
    if (row.condition == condition && row.organ == organ && counted.contain(row.sample))
      values[row.step].push_back(figure.value(row));
  std::vector<Aggregate> aggregates;
  for (const auto &[step, runs] : values)
    aggregates.push_back(aggregate_of(runs));
  return aggregates;
}

std::optional<Aggregate> metric_at_last_step(const Evaluation &evaluation, const std::string &condition,
                                             const std::string &organ, const MetricFigure &figure)
{
  const CountedRuns counted(evaluation, condition);
  std::vector<double> values;
  for (const StepMetrics &row : evaluation.metrics_by_step)
    if (row.condition == condition && row.organ == organ && row.step == evaluation.n_steps() &&
        counted.contain(row.sample))
      values.push_back(figure.value(row));
  return values.empty() ? std::nullopt : std::optional(aggregate_of(values));
}

std::vector<DistanceAggregate> error_by_distance(const Evaluation &evaluation, const std::string &condition,
                                                 const std::string &organ)
{
  const CountedRuns counted(evaluation, condition);
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> means;
  for (const DistanceError &row : evaluation.by_distance)
    if (row.condition == condition && row.organ == organ && counted.contain(row.sample))
    {
      means[row.bin].first.push_back(row.distance.mean);
      means[row.bin].second.push_back(row.material_mean);
    }
  std::vector<DistanceAggregate> aggregates;
  for (const auto &[bin, values] : means)
    aggregates.push_back({bin, aggregate_of(values.first), aggregate_of(values.second)});
  return aggregates;
}
} // namespace pelvireg::runner
