// Random numbers that depend on nothing but (seed, stream, sample, index): the same in any order, on any number of
// threads and in any shard.
#pragma once

#include <array>
#include <cstdint>

namespace pelvireg::runner
{
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

/// As in counter_random.h, of a place in a stream.
std::array<double, 2> uniform_pair(std::uint64_t seed, const Counter &counter);
std::array<double, 2> normal_pair(std::uint64_t seed, const Counter &counter);
} // namespace pelvireg::runner
