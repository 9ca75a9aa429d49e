#include "validation/runner/random_numbers.h"

#include "synthetic/dataset/counter_random.h"

namespace pelvireg::runner
{
namespace
{
std::array<std::uint32_t, 4> words_of(std::uint64_t seed, const Counter &counter)
{
  return dataset::philox4x32({static_cast<std::uint32_t>(counter.sample), counter.index,
                              static_cast<std::uint32_t>(counter.stream), counter.subindex},
                             seed);
}
} // namespace

std::array<double, 2> uniform_pair(std::uint64_t seed, const Counter &counter)
{
  return dataset::uniform_pair(words_of(seed, counter));
}

std::array<double, 2> normal_pair(std::uint64_t seed, const Counter &counter)
{
  return dataset::normal_pair(words_of(seed, counter));
}
} // namespace pelvireg::runner
