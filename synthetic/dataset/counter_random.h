// Random numbers without a state: they depend on a counter and a key alone, so on no order, thread or shard.
#pragma once

#include <array>
#include <cstdint>

namespace pelvireg::dataset
{
/// Philox 4x32-10 (Salmon, Moraes, Dror, Shaw 2011): four random words from a counter and a key, whose low word comes
/// first in the publication.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::uint64_t key);

/// Two independent numbers, uniform in [0, 1), multiples of 2^-53.
std::array<double, 2> uniform_pair(const std::array<std::uint32_t, 4> &words);

/// Two independent standard normal numbers (Box and Muller 1958).
std::array<double, 2> normal_pair(const std::array<std::uint32_t, 4> &words);
} // namespace pelvireg::dataset
