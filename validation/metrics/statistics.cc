#include "validation/metrics/statistics.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pelvireg::metrics
{
namespace
{
double percentile(const std::vector<double> &sorted, double fraction)
{
  const double rank = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(rank));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}
} // namespace

Statistics describe(const std::vector<double> &values)
{
  if (values.empty())
    throw InputError("statistics: got no values, at least one is needed; check that sample and target are not empty");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("statistics: value {} is {}, must be finite; the positions it comes from are broken",
                                   i, values[i]));

  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values)
    sum += value;
  const double mean = sum / n;
  double sum_of_squares = 0;
  for (const double value : values)
    sum_of_squares += (value - mean) * (value - mean);

  Statistics statistics;
  statistics.n = static_cast<int>(values.size());
  statistics.mean = mean;
  statistics.sd = values.size() > 1 ? std::sqrt(sum_of_squares / (n - 1)) : 0.0;
  statistics.p95 = percentile(sorted, 0.95);
  statistics.max = sorted.back();
  return statistics;
}
} // namespace pelvireg::metrics
