// How much of each pixel lies inside closed outlines.
#pragma once

#include "synthetic/dataset/image_series.h"

#include <Eigen/Core>

#include <vector>

namespace pelvireg::observation
{
/// rows x columns.
using Raster = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A closed polyline in pixels: (column, row), the centre of the first pixel at (0, 0).
using PixelLoop = std::vector<Eigen::Vector2d>;

/// Adds the exact share of each pixel's area that the loop encloses, positive when going from column to row axis is the
/// loop's sense of rotation, negative otherwise: an outline and its holes add up. What lies outside the raster is cut
/// off. Signed areas of edges, summed along each row.
void add_coverage(const PixelLoop &loop, Raster &coverage);

/// A point in space, projected along the image's normal.
Eigen::Vector2d to_pixel(const dataset::ImageGeometry &geometry, const Eigen::Vector3d &point);
Eigen::Vector3d to_point(const dataset::ImageGeometry &geometry, double column, double row);

/// The same field of view on pixels `factor` times as fine.
dataset::ImageGeometry refined(const dataset::ImageGeometry &geometry, int factor);
} // namespace pelvireg::observation
