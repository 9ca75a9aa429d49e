#include "synthetic/observation/images/random_field.h"

#include <cmath>
#include <numbers>

namespace pelvireg::observation
{
namespace
{
double unit(std::uint32_t high, std::uint32_t low)
{
  return static_cast<double>((static_cast<std::uint64_t>(high) << 32 | low) >> 11) * 0x1.0p-53;
}

/// A well mixed word of a lattice point (finaliser of MurmurHash3, Appleby 2011).
std::uint32_t lattice_word(std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t stream)
{
  std::uint32_t word = stream * 0x9E3779B9u;
  for (const std::int32_t index : {i, j, k})
  {
    word = (word ^ static_cast<std::uint32_t>(index)) * 0x85EBCA6Bu;
    word ^= word >> 13;
    word *= 0xC2B2AE35u;
    word ^= word >> 16;
  }
  return word;
}

/// Gradient towards the middle of one of a cube's twelve edges, times the offset.
double slope(std::uint32_t word, double x, double y, double z)
{
  const std::uint32_t edge = word & 15;
  const double u = edge < 8 ? x : y;
  const double v = edge < 4 ? y : (edge == 12 || edge == 14 ? x : z);
  return ((edge & 1) ? -u : u) + ((edge & 2) ? -v : v);
}

double fade(double t)
{
  return t * t * t * (t * (t * 6 - 15) + 10);
}
} // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::uint64_t key)
{
  // Multipliers and Weyl constants of the publication, table 2 and section 3.3.
  std::uint32_t key_0 = static_cast<std::uint32_t>(key), key_1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round, key_0 += 0x9E3779B9u, key_1 += 0xBB67AE85u)
  {
    const std::uint64_t a = std::uint64_t{0xD2511F53u} * counter[0], b = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key_0, static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key_1, static_cast<std::uint32_t>(a)};
  }
  return counter;
}

std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t image, std::uint32_t index)
{
  const std::array<std::uint32_t, 4> words = philox({index, image, 0, 0}, seed);
  const double radius = std::sqrt(-2 * std::log1p(-unit(words[0], words[1]))); // 1 - u lies in (0, 1]
  const double angle = 2 * std::numbers::pi * unit(words[2], words[3]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double gradient_noise(const Eigen::Vector3d &point, double cell, std::uint32_t stream)
{
  const Eigen::Vector3d scaled = point / cell;
  const Eigen::Vector3d base(std::floor(scaled.x()), std::floor(scaled.y()), std::floor(scaled.z()));
  const Eigen::Vector3d t = scaled - base;
  const Eigen::Vector3i corner = base.cast<int>();
  double value = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
      {
        const double weight = (i ? fade(t.x()) : 1 - fade(t.x())) * (j ? fade(t.y()) : 1 - fade(t.y())) *
                              (k ? fade(t.z()) : 1 - fade(t.z()));
        value += weight * slope(lattice_word(corner.x() + i, corner.y() + j, corner.z() + k, stream), t.x() - i,
                                t.y() - j, t.z() - k);
      }
  return value;
}

double tissue_texture(const Eigen::Vector3d &material_point, std::uint32_t stream)
{
  return 0.6 * gradient_noise(material_point, 12, 3 * stream) +
         0.5 * gradient_noise(material_point, 6, 3 * stream + 1) +
         0.4 * gradient_noise(material_point, 3.5, 3 * stream + 2);
}
} // namespace pelvireg::observation
