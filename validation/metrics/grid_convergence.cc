#include "validation/metrics/grid_convergence.h"

#include "synthetic/dataset/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
constexpr double least_order = 1, largest_order = 3;
constexpr double trusted_factor = 1.25, cautious_factor = 3;

void require_usable(const GridSeries &series)
{
  const Eigen::Index n = series.middle.rows();
  if (n == 0 || series.coarse.rows() != n || series.fine.rows() != n)
    throw InputError("grid convergence: the three fields must have the same number of points, at least one");
  if (!series.coarse.allFinite() || !series.middle.allFinite() || !series.fine.allFinite())
    throw InputError("grid convergence: a value is not finite; solve the meshes again");
  if (!(series.coarse_ratio > 1) || !(series.fine_ratio > 1))
    throw InputError("grid convergence: each mesh must be finer than the one before it; choose other cell sizes");
}

double root_mean_square(const dataset::Points &difference)
{
  return std::sqrt(difference.rowwise().squaredNorm().mean());
}

/// p = (ln(coarse / fine difference) + ln((r_f^p - 1) / (r_c^p - 1))) / ln r_f, by repetition; the second term vanishes
/// when both ratios are the same.
double observed_order(double coarse_difference, double fine_difference, const GridSeries &series)
{
  if (fine_difference == 0)
    return std::numeric_limits<double>::infinity();
  if (coarse_difference == 0)
    return -std::numeric_limits<double>::infinity();
  double order = std::log(coarse_difference / fine_difference) / std::log(series.fine_ratio);
  if (!(order > 0))
    return order;
  for (int repetition = 0; repetition < 100; ++repetition)
  {
    const double shape =
        std::log((std::pow(series.fine_ratio, order) - 1) / (std::pow(series.coarse_ratio, order) - 1));
    const double next = (std::log(coarse_difference / fine_difference) + shape) / std::log(series.fine_ratio);
    if (!(next > 0))
      break;
    order = next;
  }
  return order;
}
} // namespace

GridConvergence grid_convergence(const GridSeries &series)
{
  require_usable(series);
  GridConvergence result;
  const dataset::Points difference = series.middle - series.fine;
  result.coarse_difference = root_mean_square(series.coarse - series.middle);
  result.fine_difference = root_mean_square(difference);
  result.observed_order = observed_order(result.coarse_difference, result.fine_difference, series);
  result.used_order = std::clamp(result.observed_order, least_order, largest_order);
  result.safety_factor = result.observed_order >= least_order ? trusted_factor : cautious_factor;
  const double growth = std::pow(series.fine_ratio, result.used_order);
  for (Eigen::Index i = 0; i < difference.rows(); ++i)
    result.index.push_back(result.safety_factor * difference.row(i).norm() / (growth - 1));
  return result;
}
} // namespace pelvireg::metrics
