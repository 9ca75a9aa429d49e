#include "synthetic/dataset/counter_random.h"

#include <cmath>
#include <numbers>

namespace pelvireg::dataset
{
namespace
{
double unit(std::uint32_t high, std::uint32_t low)
{
  return static_cast<double>((static_cast<std::uint64_t>(high) << 32 | low) >> 11) * 0x1.0p-53;
}
} // namespace

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::uint64_t key)
{
  // Multipliers and Weyl constants of the publication, table 2 and section 3.3.
  constexpr std::uint64_t multiplier_0 = 0xD2511F53u;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57u;
  constexpr std::uint32_t weyl_0 = 0x9E3779B9u;
  constexpr std::uint32_t weyl_1 = 0xBB67AE85u;
  std::uint32_t key_0 = static_cast<std::uint32_t>(key), key_1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round)
  {
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key_0, static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key_1, static_cast<std::uint32_t>(product_0)};
    key_0 += weyl_0;
    key_1 += weyl_1;
  }
  return counter;
}

std::array<double, 2> uniform_pair(const std::array<std::uint32_t, 4> &words)
{
  return {unit(words[0], words[1]), unit(words[2], words[3])};
}

std::array<double, 2> normal_pair(const std::array<std::uint32_t, 4> &words)
{
  const auto [first, second] = uniform_pair(words);
  const double radius = std::sqrt(-2 * std::log1p(-first)); // 1 - first lies in (0, 1]
  const double angle = 2 * std::numbers::pi * second;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}
} // namespace pelvireg::dataset
