// Between space and the pixels of an image.
#pragma once

#include "registration/tracking/outline_tracker.h"
#include "synthetic/dataset/geometry.h"
#include "synthetic/dataset/image_series.h"

namespace pelvireg::runner
{
/// Column and row (0, 0: centre of the first pixel) of points in space, along the plane's normal: n x 2.
tracking::PixelPoints to_pixels(const dataset::ImageGeometry &geometry, const dataset::Points &points);
/// n x 3, mm, in the image plane.
dataset::Points to_space(const dataset::ImageGeometry &geometry, const tracking::PixelPoints &pixels);
/// mm: largest distance of the points from the image plane.
double distance_from_plane(const dataset::ImageGeometry &geometry, const dataset::Points &points);
/// Frame `number` (0-based).
tracking::Image frame_of(const dataset::ImageSeries &series, std::size_t number);
} // namespace pelvireg::runner
