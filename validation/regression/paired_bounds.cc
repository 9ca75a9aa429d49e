#include "validation/regression/paired_bounds.h"

#include "synthetic/dataset/error.h"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pelvireg::regression
{
namespace
{
double student_quantile(int n, double level)
{
  return boost::math::quantile(boost::math::complement(boost::math::students_t(n - 1), level));
}

void require_usable(Eigen::Index n, bool are_finite, double level)
{
  if (n < 2 || !are_finite || !(level > 0 && level < 0.5))
    throw InputError(fmt::format("bounds of a mean: got {} values, {}, level {}; needed are at least two, all finite, "
                                 "and a level between 0 and 0.5",
                                 n, are_finite ? "all finite" : "some not finite", level));
}

/// SplitMix64's finaliser.
std::uint64_t mixed(std::uint64_t z)
{
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// In [0, n).
Eigen::Index draw(std::uint64_t seed, int resample, int k, int n)
{
  constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15u;
  const std::uint64_t counter = static_cast<std::uint64_t>(resample) << 32 | static_cast<std::uint32_t>(k);
  const std::uint64_t word = mixed(mixed(seed + golden_gamma) + golden_gamma * (counter + 1));
  return static_cast<Eigen::Index>((word >> 32) * static_cast<std::uint64_t>(n) >> 32);
}
} // namespace

MeanBounds mean_bounds(const std::vector<double> &values, double level)
{
  const Eigen::Map<const Eigen::ArrayXd> x(values.data(), static_cast<Eigen::Index>(values.size()));
  require_usable(x.size(), x.isFinite().all(), level);
  MeanBounds bounds{static_cast<int>(x.size()), x.mean(), 0, 0, 0};
  bounds.sd = std::sqrt((x - bounds.mean).square().sum() / static_cast<double>(x.size() - 1));
  const double reach = student_quantile(bounds.n, level) * bounds.sd / std::sqrt(static_cast<double>(bounds.n));
  bounds.lower = bounds.mean - reach;
  bounds.upper = bounds.mean + reach;
  return bounds;
}

Eigen::MatrixXd bootstrap_shares(int n, int n_resamples, std::uint64_t seed)
{
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(n_resamples, n);
  for (int r = 0; r < n_resamples; ++r)
    for (int k = 0; k < n; ++k)
      shares(r, draw(seed, r, k, n)) += 1.0 / n;
  return shares;
}

Band simultaneous_band(const Eigen::MatrixXd &curves, const Eigen::MatrixXd &shares, double level)
{
  const int n = static_cast<int>(curves.rows());
  require_usable(n, curves.allFinite(), level);
  Band band;
  band.mean = curves.colwise().mean().transpose();
  const Eigen::MatrixXd centred = curves.rowwise() - band.mean.transpose();
  const Eigen::ArrayXd error = (centred.colwise().squaredNorm().transpose().array() / (n - 1.0) / n).sqrt();
  const Eigen::ArrayXd weight = (error > 0).select(1 / error, 0); // where all runs agree there is nothing to miss
  const Eigen::MatrixXd deviations = shares * centred;
  std::vector<double> largest(static_cast<std::size_t>(deviations.rows()));
  for (Eigen::Index r = 0; r < deviations.rows(); ++r)
    largest[static_cast<std::size_t>(r)] = (deviations.row(r).transpose().array().abs() * weight).maxCoeff();
  const auto rank = static_cast<std::size_t>(
      std::clamp(std::ceil((1 - level) * static_cast<double>(largest.size())), 1.0, 1.0 * largest.size()));
  std::nth_element(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(rank) - 1, largest.end());
  band.critical = std::max(largest[rank - 1] * std::sqrt(n / (n - 1.0)), student_quantile(n, level / 2));
  band.lower = band.mean.array() - band.critical * error;
  band.upper = band.mean.array() + band.critical * error;
  return band;
}
} // namespace pelvireg::regression
