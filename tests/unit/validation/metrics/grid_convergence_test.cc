// Observed order and error bar of fields whose error is known.
#include "synthetic/dataset/error.h"
#include "validation/metrics/grid_convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::metrics
{
namespace
{
/// f + c h^p at k points, c different at each; cell sizes coarse_ratio fine_ratio, fine_ratio and 1.
GridSeries series_of_order(double order, double coarse_ratio, double fine_ratio)
{
  const int k = 20;
  dataset::Points exact(k, 3), error(k, 3);
  for (Eigen::Index i = 0; i < exact.size(); ++i)
  {
    exact.data()[i] = std::sin(static_cast<double>(i));
    error.data()[i] = 0.01 * std::cos(2 * static_cast<double>(i));
  }
  return {exact + std::pow(coarse_ratio * fine_ratio, order) * error, exact + std::pow(fine_ratio, order) * error,
          exact + error, coarse_ratio, fine_ratio};
}

TEST(GridConvergence, FindsTheOrderAndAnErrorBarOfFiveQuartersOfTheTrueError)
{
  for (const double order : {1.1, 1.7, 2.0, 2.9})
  {
    const GridConvergence found = grid_convergence(series_of_order(order, std::sqrt(2), std::sqrt(2)));
    EXPECT_NEAR(found.observed_order, order, 1e-10);
    EXPECT_EQ(found.safety_factor, 1.25);
    for (std::size_t i = 0; i < found.index.size(); ++i)
    {
      const Eigen::Vector3d error(std::cos(6. * i), std::cos(6. * i + 2), std::cos(6. * i + 4));
      EXPECT_NEAR(found.index[i], 1.25 * 0.01 * error.norm(), 1e-10);
    }
  }
}

TEST(GridConvergence, FindsTheOrderFromTwoDifferentRatiosToo)
{
  EXPECT_NEAR(grid_convergence(series_of_order(2, 1.5, 1.3)).observed_order, 2, 1e-8);
}

TEST(GridConvergence, TrustsNoDifferencesThatGrowAndNoOrderAboveThatOfTheCells)
{
  GridSeries diverging = series_of_order(2, 1.4, 1.4);
  diverging.coarse = diverging.middle + 0.5 * (diverging.fine - diverging.middle);
  const GridConvergence found = grid_convergence(diverging);
  EXPECT_LT(found.observed_order, 0);
  EXPECT_EQ(found.used_order, 1);
  EXPECT_EQ(found.safety_factor, 3);
  const GridConvergence lucky = grid_convergence(series_of_order(6, 1.4, 1.4));
  EXPECT_EQ(lucky.used_order, 3);
}

TEST(GridConvergence, RefusesWhatIsNoSeries)
{
  GridSeries series = series_of_order(2, 1.4, 1.4);
  series.fine_ratio = 1;
  EXPECT_THROW(grid_convergence(series), InputError);
  series = series_of_order(2, 1.4, 1.4);
  series.coarse(0, 0) = std::nan("");
  EXPECT_THROW(grid_convergence(series), InputError);
  series = series_of_order(2, 1.4, 1.4);
  series.fine.conservativeResize(3, 3);
  EXPECT_THROW(grid_convergence(series), InputError);
}
} // namespace
} // namespace pelvireg::metrics
