#include "validation/metrics/statistics.h"

#include "synthetic/dataset/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pelvireg::metrics
{
namespace
{
TEST(Statistics, OfOneToFiveAreTheTextbookValues)
{
  const Statistics statistics = describe({5, 1, 4, 2, 3});
  EXPECT_EQ(statistics.n, 5);
  EXPECT_DOUBLE_EQ(statistics.mean, 3);
  EXPECT_DOUBLE_EQ(statistics.sd, std::sqrt(2.5)); // n - 1 = 4
  EXPECT_DOUBLE_EQ(statistics.p95, 4.8);           // type 7: rank 0.95 * 4
  EXPECT_DOUBLE_EQ(statistics.max, 5);
}

TEST(Statistics, OfOneValueHaveNoSpread)
{
  const Statistics statistics = describe({2.5});
  EXPECT_EQ(statistics.sd, 0);
  EXPECT_EQ(statistics.p95, 2.5);
}

TEST(Statistics, RefuseNoValuesAndNotFiniteOnes)
{
  EXPECT_THROW(describe({}), InputError);
  EXPECT_THROW(describe({1, std::nan(""), 2}), InputError);
  EXPECT_THROW(describe({1, std::numeric_limits<double>::infinity()}), InputError);
}
} // namespace
} // namespace pelvireg::metrics
