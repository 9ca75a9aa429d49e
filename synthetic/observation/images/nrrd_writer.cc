#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/image_checks.h"
#include "synthetic/observation/images/image_files.h"
#include "synthetic/observation/images/nrrd_header.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <bit>
#include <string_view>

namespace pelvireg::observation
{
namespace
{
static_assert(std::endian::native == std::endian::little, "pixels are written as they lie in memory");

std::string text_of(const Eigen::Vector3d &vector)
{
  return fmt::format("({},{},{})", exact_text(vector.x()), exact_text(vector.y()), exact_text(vector.z()));
}

std::string steps_of(const dataset::ImageGeometry &geometry)
{
  return text_of(geometry.spacing[0] * geometry.column_direction) + " " +
         text_of(geometry.spacing[1] * geometry.row_direction);
}

std::string head_of(const dataset::ImageGeometry &geometry, const std::string &description)
{
  if (description.find_first_of("\r\n") != std::string::npos)
    throw InputError("The description of an image has more than one line, but one is allowed; shorten it.");
  return fmt::format("NRRD0005\ncontent: {}\ntype: float\nspace: left-posterior-superior\nspace origin: {}\n"
                     "endian: little\nencoding: raw\n",
                     description, text_of(geometry.origin));
}

void write(const std::filesystem::path &file, std::string head, const std::vector<float> &pixels)
{
  head.append(reinterpret_cast<const char *>(pixels.data()), pixels.size() * sizeof(float));
  dataset::write_text_file(file, head);
}
} // namespace

void write_nrrd(const dataset::ImageSeries &series, const std::filesystem::path &file)
{
  check(series, fmt::format("The image for '{}'", file.string()));
  const dataset::ImageGeometry &geometry = series.geometry;
  const Eigen::Vector3d normal = geometry.column_direction.cross(geometry.row_direction);
  std::string head = head_of(geometry, series.description);
  head += fmt::format("dimension: 4\nsizes: {} {} 1 {}\n", geometry.columns, geometry.rows, series.times_s.size());
  head +=
      fmt::format("space directions: {} {} none\n", steps_of(geometry), text_of(series.slice_thickness_mm * normal));
  head += fmt::format("kinds: domain domain domain list\nthicknesses: nan nan {} nan\n",
                      exact_text(series.slice_thickness_mm));
  head += "labels: \"column\" \"row\" \"slice\" \"time\"\nunits: \"\" \"\" \"\" \"s\"\n"
          "DataNodeClassName:=vtkMRMLScalarVolumeNode\naxis 3 index type:=numeric\naxis 3 index values:=";
  for (std::size_t i = 0; i < series.times_s.size(); ++i)
    head += (i > 0 ? " " : "") + exact_text(series.times_s[i]);
  write(file, head + "\n\n", series.pixels);
}

void write_nrrd(const dataset::ImageVolume &volume, const std::filesystem::path &file)
{
  check(volume, fmt::format("The image for '{}'", file.string()));
  const dataset::ImageGeometry &geometry = volume.geometry;
  std::string head = head_of(geometry, volume.description);
  head += fmt::format("dimension: 3\nsizes: {} {} {}\n", geometry.columns, geometry.rows, volume.slices);
  head += fmt::format("space directions: {} {}\n", steps_of(geometry), text_of(volume.slice_step));
  head += fmt::format("kinds: domain domain domain\nthicknesses: nan nan {}\n", exact_text(volume.slice_thickness_mm));
  head += "labels: \"column\" \"row\" \"slice\"\n";
  write(file, head + "\n", volume.pixels);
}
} // namespace pelvireg::observation
