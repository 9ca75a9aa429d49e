#include "validation/runner/perturbation.h"

namespace pelvireg::runner
{
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key)
{
  // Multipliers and Weyl constants of the publication, table 2 and section 3.3.
  constexpr std::uint64_t multiplier_0 = 0xD2511F53u;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57u;
  constexpr std::uint32_t weyl_0 = 0x9E3779B9u;
  constexpr std::uint32_t weyl_1 = 0xBB67AE85u;
  for (int round = 0; round < 10; ++round)
  {
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product_0)};
    key[0] += weyl_0;
    key[1] += weyl_1;
  }
  return counter;
}

double modulus_factor(std::uint64_t seed, int sample, int body, double spread)
{
  if (sample == 0)
    return 1.0;
  const std::array<std::uint32_t, 4> words =
      philox4x32({static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(body), 0, 0},
                 {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  const std::uint64_t bits = (static_cast<std::uint64_t>(words[0]) << 32 | words[1]) >> 11;
  const double unit = static_cast<double>(bits) * 0x1.0p-53;
  return 1.0 + spread * (2.0 * unit - 1.0);
}
} // namespace pelvireg::runner
