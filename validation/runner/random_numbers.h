// Random numbers that depend on nothing but (seed, stream, sample, index): the same in any order, on any number of
// threads and in any shard.
#pragma once

#include <array>
#include <cstdint>

namespace pelvireg::runner
{
/// Philox 4x32-10 (Salmon, Moraes, Dror, Shaw 2011): four random words from a counter and a key, with no state.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// What the numbers are for: numbers of different streams are independent.
enum class Stream : std::uint32_t
{
  modulus = 0,
  surface = 1,
  outline = 2,
  plane = 3
};

/// Where in its stream a number stands.
struct Counter
{
  Stream stream = Stream::modulus;
  int sample = 0;
  std::uint32_t index = 0, subindex = 0;
};

/// Two independent numbers, uniform in [0, 1), multiples of 2^-53.
std::array<double, 2> uniform_pair(std::uint64_t seed, const Counter &counter);

/// Two independent standard normal numbers (Box and Muller 1958).
std::array<double, 2> normal_pair(std::uint64_t seed, const Counter &counter);
} // namespace pelvireg::runner
