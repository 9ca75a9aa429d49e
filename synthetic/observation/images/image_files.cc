#include "synthetic/observation/images/image_files.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/dicom_series.h"
#include "synthetic/observation/images/nrrd_file.h"

#include <fmt/format.h>

namespace pelvireg::observation
{
namespace
{
/// Whether the path is a folder; throws when it is nothing.
bool is_folder(const std::filesystem::path &path)
{
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("The image '{}' does not exist; give an .nrrd file or a folder with a DICOM series.",
                                 path.string()));
  return std::filesystem::is_directory(path);
}
} // namespace

dataset::ImageSeries read_image_series(const std::filesystem::path &path)
{
  return is_folder(path) ? read_dicom_series(path) : read_nrrd_series(path);
}

dataset::ImageVolume read_image_volume(const std::filesystem::path &path)
{
  return is_folder(path) ? read_dicom_volume(path) : read_nrrd_volume(path);
}
} // namespace pelvireg::observation
