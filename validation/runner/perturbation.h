// Random Young's moduli that depend on nothing but (seed, sample, body).
#pragma once

#include <array>
#include <cstdint>

namespace pelvireg::runner
{
/// Philox 4x32-10 (Salmon, Moraes, Dror, Shaw 2011): four random words from a counter and a key, with no state.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// Factor of body `body`'s Young's modulus in run `sample`: 1 + spread U, U uniform in [-1, 1). Sample 0 is nominal: 1.
/// The same triple gives the same factor in any order, on any number of threads and in any shard.
double modulus_factor(std::uint64_t seed, int sample, int body, double spread);
} // namespace pelvireg::runner
