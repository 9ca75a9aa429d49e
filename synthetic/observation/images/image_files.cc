#include "synthetic/observation/images/image_files.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/nrrd_file.h"

#include <fmt/format.h>

namespace pelvireg::observation
{
dataset::ImageSeries read_image_series(const std::filesystem::path &path)
{
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("The image '{}' does not exist; give an .nrrd file or a folder with a DICOM series.",
                                 path.string()));
  return read_nrrd_series(path);
}

dataset::ImageVolume read_image_volume(const std::filesystem::path &path)
{
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("The image '{}' does not exist; give an .nrrd file or a folder with a DICOM series.",
                                 path.string()));
  return read_nrrd_volume(path);
}
} // namespace pelvireg::observation
