// NRRD files as images. What the files may hold: image_files.h.
#pragma once

#include "synthetic/dataset/image_series.h"

#include <filesystem>

namespace pelvireg::observation
{
/// Throw InputError; the result has passed check() of image_checks.h.
dataset::ImageSeries read_nrrd_series(const std::filesystem::path &file);
dataset::ImageVolume read_nrrd_volume(const std::filesystem::path &file);
} // namespace pelvireg::observation
