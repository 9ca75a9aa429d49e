// Bounds with known answers.
#include "validation/regression/paired_bounds.h"

#include "synthetic/dataset/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pelvireg::regression
{
namespace
{
TEST(MeanBounds, AreStudentsT)
{
  // n = 5, mean 3, sd sqrt(2.5), t(0.99, 4) = 3.74695 (tables): 3 +- 3.74695 * 0.707107.
  const MeanBounds bounds = mean_bounds({1, 2, 3, 4, 5}, 0.01);
  EXPECT_DOUBLE_EQ(bounds.mean, 3);
  EXPECT_NEAR(bounds.sd, std::sqrt(2.5), 1e-14);
  EXPECT_NEAR(bounds.upper, 3 + 3.74695 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(bounds.lower, 3 - 3.74695 * std::sqrt(0.5), 1e-5);
}

TEST(MeanBounds, OfEqualRunsAreTheMean)
{
  const MeanBounds bounds = mean_bounds({0.25, 0.25, 0.25, 0.25}, 0.01);
  EXPECT_EQ(bounds.lower, 0.25);
  EXPECT_EQ(bounds.upper, 0.25);
}

TEST(MeanBounds, RefuseWhatIsNotFiniteOrAlone)
{
  EXPECT_THROW(mean_bounds({1, std::nan("")}, 0.01), InputError);
  EXPECT_THROW(mean_bounds({1, std::numeric_limits<double>::infinity()}, 0.01), InputError);
  EXPECT_THROW(mean_bounds({1}, 0.01), InputError);
  EXPECT_THROW(mean_bounds({1, 2}, std::nan("")), InputError);
}

TEST(BootstrapShares, DependOnNothingButSeedResampleAndDraw)
{
  const Eigen::MatrixXd many = bootstrap_shares(8, 1000, 5), few = bootstrap_shares(8, 10, 5);
  EXPECT_EQ(many.topRows(10), few);
  EXPECT_NE(few, bootstrap_shares(8, 10, 6));
  EXPECT_TRUE(many.rowwise().sum().isApproxToConstant(1, 1e-12));
  // Each run is drawn once a resample on average; its share has variance (1 - 1/n) / n^2.
  const Eigen::RowVectorXd mean = many.colwise().mean();
  EXPECT_TRUE(mean.isApproxToConstant(1.0 / 8, 0.05)) << mean;
  const double variance = (many.array() - 1.0 / 8).square().mean();
  EXPECT_NEAR(variance, (1 - 1.0 / 8) / 64, 0.05 / 64);
}

/// n curves of independent normal values: sums of twelve uniform numbers of a linear congruential generator.
Eigen::MatrixXd random_curves(int n, int length, std::uint64_t seed)
{
  std::uint64_t state = seed * 0x9E3779B97F4A7C15u + 1;
  Eigen::MatrixXd curves(n, length);
  for (double &value : curves.reshaped())
  {
    value = -6;
    for (int k = 0; k < 12; ++k)
    {
      state = state * 6364136223846793005u + 1442695040888963407u;
      value += static_cast<double>(state >> 11) * 0x1.0p-53;
    }
  }
  return curves;
}

TEST(SimultaneousBand, HoldsTheWholeTrueCurveAsOftenAsItSays)
{
  // 20 independent places, true curve 0, level 0.05; 600 trials: 0.95 +- 0.027 (three standard errors). Few runs must
  // not make it narrower than it says.
  const Eigen::MatrixXd shares = bootstrap_shares(40, 999, 11);
  int n_held = 0;
  constexpr int n_trials = 600;
  for (int trial = 1; trial <= n_trials; ++trial)
  {
    const Band band = simultaneous_band(random_curves(40, 20, static_cast<std::uint64_t>(trial)), shares, 0.05);
    n_held += (band.lower.array() <= 0).all() && (band.upper.array() >= 0).all();
  }
  EXPECT_GE(n_held, static_cast<int>(0.90 * n_trials));
  EXPECT_LE(n_held, static_cast<int>(0.98 * n_trials));
}

TEST(SimultaneousBand, HasNoWidthWhereAllRunsAgree)
{
  Eigen::MatrixXd curves = random_curves(8, 3, 1);
  curves.col(1).setConstant(0.5);
  const Band band = simultaneous_band(curves, bootstrap_shares(8, 999, 1), 0.01);
  EXPECT_EQ(band.lower[1], 0.5);
  EXPECT_EQ(band.upper[1], 0.5);
  EXPECT_LT(band.lower[0], band.mean[0]);
}

TEST(SimultaneousBand, IsNeverNarrowerThanStudentsT)
{
  // Of four equal-spaced runs resampling sees too little: t(0.995, 3) = 5.84091 (tables).
  Eigen::MatrixXd curves(4, 1);
  curves << 1, 2, 3, 4;
  const Band band = simultaneous_band(curves, bootstrap_shares(4, 999, 1), 0.01);
  EXPECT_GE(band.critical, 5.8409);
  EXPECT_NEAR(band.lower[0], 2.5 - band.critical * std::sqrt(5.0 / 3 / 4), 1e-12); // variance of 1, 2, 3, 4: 5/3
}

TEST(SimultaneousBand, RefusesWhatIsNotFinite)
{
  Eigen::MatrixXd curves = random_curves(8, 3, 1);
  curves(4, 2) = std::nan("");
  EXPECT_THROW(simultaneous_band(curves, bootstrap_shares(8, 99, 1), 0.01), InputError);
}
} // namespace
} // namespace pelvireg::regression
