// The images stage: MR images of the truth, and its command.
#pragma once

#include "synthetic/observation/images/make_images.h"
#include "validation/cli/stage_cache.h"

namespace pelvireg::cli
{
/// images/dyn.nrrd, images/tse.nrrd, images/ffe.nrrd and the same as DICOM series in images/dyn, images/tse,
/// images/ffe. `options.progress` is set here; the number of threads changes nothing in the files.
void make_image_files(ResultDirectory &directory, observation::ImageOptions options);
} // namespace pelvireg::cli
