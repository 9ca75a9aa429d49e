// What every image must fulfil, whoever made it.
#pragma once

#include "synthetic/dataset/image_series.h"

#include <string>

namespace pelvireg::observation
{
/// Sizes, positive spacing, unit and perpendicular directions (to 1e-4), one strictly increasing time a frame, as many
/// pixels as the sizes say, all finite. `where` names the image ("the image 'dyn.nrrd'"). Throws InputError.
void check(const dataset::ImageSeries &series, const std::string &where);

/// Likewise; the step between slices is normal to them (to 1e-3 of its length).
void check(const dataset::ImageVolume &volume, const std::string &where);
} // namespace pelvireg::observation
