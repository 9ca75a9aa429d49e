// What a handful of paired runs can prove.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pelvireg::regression
{
/// Mean of n differences with its two one-sided bounds (Student's t). A standard deviation of zero gives bounds equal
/// to the mean: runs without a change are equal to the last bit.
struct MeanBounds
{
  int n = 0;
  double mean = 0, sd = 0, lower = 0, upper = 0;
};

/// level: probability that the mean lies above `upper`, and below `lower`. Throws InputError for fewer than two values,
/// one that is not finite, or a level outside (0, 0.5).
MeanBounds mean_bounds(const std::vector<double> &values, double level);

/// Bootstrap resamples of n runs: row r holds the share of each run in resample r; shares sum to 1. Draw k of resample
/// r is a function of (seed, r, k) alone (SplitMix64's finaliser over the counter; Steele, Lea, Flood 2014), so the
/// same on every machine and for any number of threads.
Eigen::MatrixXd bootstrap_shares(int n, int n_resamples, std::uint64_t seed);

/// Mean curve of n runs and a band that holds the true mean curve as a whole.
struct Band
{
  Eigen::VectorXd mean, lower, upper; ///< one entry an abscissa
  double critical = 0;                ///< half width in standard errors
};

/// curves: n x abscissae. Studentised maximum over the abscissae (sup-t), two-sided: both borders miss with probability
/// `level` in all. Resampling few runs understates their scatter, so the width is never below that of Student's t for a
/// single abscissa, and resamples are scaled by sqrt(n / (n - 1)). Where all runs agree the band has no width. Throws
/// as mean_bounds.
Band simultaneous_band(const Eigen::MatrixXd &curves, const Eigen::MatrixXd &shares, double level);
} // namespace pelvireg::regression
