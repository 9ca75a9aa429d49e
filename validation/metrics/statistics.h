// What a column of distances is boiled down to.
#pragma once

#include <vector>

namespace pelvireg::metrics
{
/// Summary of n distances; all in the unit of the values (mm).
struct Statistics
{
  int n = 0;
  double mean = 0;
  double sd = 0;  ///< sample standard deviation (n - 1); 0 for a single value
  double p95 = 0; ///< 95th percentile, linear between order statistics (Hyndman and Fan type 7)
  double max = 0;
};

/// Summarise. Throws InputError for no values or for one that is not finite: a silent number is worse than none.
Statistics describe(const std::vector<double> &values);
} // namespace pelvireg::metrics
