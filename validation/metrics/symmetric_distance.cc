#include "validation/metrics/symmetric_distance.h"

#include "validation/metrics/statistics.h"

#include <algorithm>

namespace pelvireg::metrics
{
SymmetricDistance symmetric_distance(const std::vector<double> &there, const std::vector<double> &back)
{
  const Statistics a = describe(there), b = describe(back);
  return {(a.n * a.mean + b.n * b.mean) / (a.n + b.n), std::max(a.p95, b.p95)};
}
} // namespace pelvireg::metrics
