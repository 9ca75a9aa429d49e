#include "synthetic/observation/images/random_field.h"

#include "synthetic/dataset/counter_random.h"

#include <cmath>

namespace pelvireg::observation
{
namespace
{
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

std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t image, std::uint32_t index)
{
  return dataset::normal_pair(dataset::philox4x32({index, image, 0, 0}, seed));
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
