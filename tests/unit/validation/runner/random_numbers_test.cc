#include "validation/runner/random_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelvireg::runner
{
namespace
{
TEST(UniformPair, DependsOnEveryPartOfItsCounter)
{
  const Counter counter{Stream::surface, 3, 5, 7};
  const auto pair = uniform_pair(11, counter);
  EXPECT_EQ(pair, uniform_pair(11, counter));
  EXPECT_NE(pair, uniform_pair(12, counter));
  EXPECT_NE(pair, uniform_pair(11 | 1ull << 40, counter));
  EXPECT_NE(pair, uniform_pair(11, {Stream::outline, 3, 5, 7}));
  EXPECT_NE(pair, uniform_pair(11, {Stream::surface, 4, 5, 7}));
  EXPECT_NE(pair, uniform_pair(11, {Stream::surface, 3, 6, 7}));
  EXPECT_NE(pair, uniform_pair(11, {Stream::surface, 3, 5, 8}));
  EXPECT_NE(pair, uniform_pair(11, {Stream::surface, 5, 3, 7})) << "sample and index must not be mixed up";
  EXPECT_NE(pair[0], pair[1]);
}

TEST(NormalPair, HasTheMomentsAndTailsOfTheNormalDistribution)
{
  constexpr int n = 50000;
  double sum = 0, squares = 0, fourths = 0, product = 0;
  int beyond_two = 0;
  for (int i = 0; i < n; ++i)
  {
    const auto [u, v] = normal_pair(5, {Stream::outline, 1, static_cast<std::uint32_t>(i), 0});
    for (const double value : {u, v})
    {
      ASSERT_TRUE(std::isfinite(value));
      sum += value;
      squares += value * value;
      fourths += std::pow(value, 4);
      beyond_two += std::abs(value) > 2;
    }
    product += u * v;
  }
  constexpr double count = 2.0 * n; // tolerances: four standard errors
  EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2 / count));
  EXPECT_NEAR(fourths / count, 3, 4 * std::sqrt(96 / count));
  EXPECT_NEAR(product / n, 0, 4 / std::sqrt(static_cast<double>(n)));
  EXPECT_NEAR(beyond_two / count, std::erfc(std::sqrt(2.0)), 4 * std::sqrt(0.0455 * 0.9545 / count));
}
} // namespace
} // namespace pelvireg::runner
