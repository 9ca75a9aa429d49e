// Random numbers and random textures that depend on nothing but a seed and where they are asked for.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace pelvireg::observation
{
/// Two independent standard normal numbers of image `image`, sample `index`.
std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t image, std::uint32_t index);

/// Gradient noise (Perlin 1985, quintic fade of 2002): smooth, mean 0, about -1 … 1, no structure finer than `cell` mm.
/// Different streams are independent.
double gradient_noise(const Eigen::Vector3d &point, double cell, std::uint32_t stream);

/// Octaves of gradient noise of cells 12, 6 and 3.5 mm: standard deviation about 0.25.
double tissue_texture(const Eigen::Vector3d &material_point, std::uint32_t stream);
} // namespace pelvireg::observation
