#include "validation/runner/perturbation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pelvireg::runner
{
namespace
{
// Known answers of philox4x32-10: Random123 1.09, tests/kat_vectors.
TEST(Philox, GivesThePublishedWords)
{
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox4x32({ones, ones, ones, ones}, {ones, ones}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(ModulusFactor, OfTheNominalRunIsOne)
{
  EXPECT_EQ(modulus_factor(1, 0, 3, 0.10), 1.0);
}

TEST(ModulusFactor, IsUniformWithinTheSpread)
{
  constexpr int n = 20000;
  double sum = 0, sum_of_squares = 0, least = 2, largest = 0;
  for (int i = 1; i <= n; ++i)
  {
    const double factor = modulus_factor(7, i, i % 5, 0.10);
    ASSERT_GE(factor, 0.9);
    ASSERT_LE(factor, 1.1);
    sum += factor - 1;
    sum_of_squares += (factor - 1) * (factor - 1);
    least = std::min(least, factor);
    largest = std::max(largest, factor);
  }
  const double sd = 0.10 / std::sqrt(3.0);
  EXPECT_NEAR(sum / n, 0, 4 * sd / std::sqrt(n)); // four standard errors
  EXPECT_NEAR(std::sqrt(sum_of_squares / n), sd, 0.02 * sd);
  EXPECT_LE(least, 0.9001);
  EXPECT_GE(largest, 1.0999);
}

TEST(ModulusFactor, DependsOnSeedSampleAndBody)
{
  const double factor = modulus_factor(1, 2, 3, 0.10);
  EXPECT_NE(factor, modulus_factor(2, 2, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1ull << 32 | 1, 2, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 3, 3, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 2, 2, 0.10));
  EXPECT_NE(factor, modulus_factor(1, 3, 2, 0.10)) << "sample and body must not be mixed up";
}
} // namespace
} // namespace pelvireg::runner
