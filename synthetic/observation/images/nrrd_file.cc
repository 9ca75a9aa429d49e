#include "synthetic/observation/images/nrrd_file.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/image_checks.h"
#include "synthetic/observation/images/nrrd_header.h"
#include "synthetic/observation/images/nrrd_samples.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace pelvireg::observation
{
namespace
{
using dataset::ImageGeometry;
using dataset::ImageSeries;
using dataset::ImageVolume;

struct NrrdFile
{
  std::string where; ///< for messages
  NrrdHeader header;
  std::vector<float> samples;
};

NrrdFile opened(const std::filesystem::path &file)
{
  NrrdFile opened;
  opened.where = fmt::format("The image '{}'", file.string());
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError(opened.where + " cannot be opened; give the path of an .nrrd file.");
  opened.header = read_nrrd_header(in, opened.where);
  opened.samples = read_nrrd_samples(in, opened.header, opened.where);
  return opened;
}

/// Which axis of the file is what, 0-based; -1: there is none.
struct Roles
{
  int column = -1, row = -1, slice = -1, time = -1;
};

/// Spatial axes in the file's order; one of size 1 is the slice when three are there and one is to be left out.
Roles roles_of(const NrrdFile &file, bool one_slice)
{
  Roles roles;
  std::vector<int> spatial;
  for (std::size_t i = 0; i < file.header.axes.size(); ++i)
  {
    const NrrdAxis &axis = file.header.axes[i];
    if (axis.step)
      spatial.push_back(static_cast<int>(i));
    else if (axis.kind.find("color") != std::string::npos || axis.kind.find("vector") != std::string::npos ||
             axis.kind == "complex" || axis.kind.find("matrix") != std::string::npos)
      throw InputError(fmt::format("{} has several values a pixel (an axis of kind '{}'), but grey images are needed; "
                                   "convert it to one value a pixel.",
                                   file.where, axis.kind));
    else if (roles.time < 0)
      roles.time = static_cast<int>(i);
    else
      throw InputError(file.where + " has two axes outside space, but one, time, is allowed; save one series alone.");
  }
  if (one_slice)
    for (auto axis = spatial.begin(); axis != spatial.end() && spatial.size() == 3; ++axis)
      if (file.header.axes[static_cast<std::size_t>(*axis)].size == 1)
      {
        roles.slice = *axis;
        spatial.erase(axis);
        break;
      }
  if (spatial.size() != (one_slice ? 2u : 3u))
    throw InputError(fmt::format("{} has {} spatial axes of more than one pixel, but {}; give another image.",
                                 file.where, spatial.size(),
                                 one_slice ? "a dynamic series of one plane has 2" : "a stack of slices has 3"));
  roles.column = spatial[0];
  roles.row = spatial[1];
  if (!one_slice)
    roles.slice = spatial[2];
  return roles;
}

const NrrdAxis &axis_at(const NrrdFile &file, int axis)
{
  return file.header.axes[static_cast<std::size_t>(axis)];
}

ImageGeometry geometry_of(const NrrdFile &file, const Roles &roles)
{
  const NrrdAxis &column = axis_at(file, roles.column), &row = axis_at(file, roles.row);
  ImageGeometry geometry;
  geometry.origin = file.header.origin;
  geometry.spacing = {column.step->norm(), row.step->norm()};
  geometry.column_direction = column.step->normalized();
  geometry.row_direction = row.step->normalized();
  geometry.columns = static_cast<int>(column.size);
  geometry.rows = static_cast<int>(row.size);
  return geometry;
}

/// Samples between neighbours along an axis.
std::size_t stride_of(const NrrdFile &file, int axis)
{
  std::size_t stride = 1;
  for (int i = 0; i < axis; ++i)
    stride *= axis_at(file, i).size;
  return stride;
}

/// The samples with `outer` slowest, then rows, then columns.
std::vector<float> arranged(const NrrdFile &file, const Roles &roles, int outer)
{
  const std::size_t n_outer = outer < 0 ? 1 : axis_at(file, outer).size;
  const std::size_t outer_stride = outer < 0 ? 0 : stride_of(file, outer);
  const std::size_t row_stride = stride_of(file, roles.row), column_stride = stride_of(file, roles.column);
  std::vector<float> pixels;
  pixels.reserve(file.samples.size());
  for (std::size_t o = 0; o < n_outer; ++o)
    for (std::size_t r = 0; r < axis_at(file, roles.row).size; ++r)
      for (std::size_t c = 0; c < axis_at(file, roles.column).size; ++c)
        pixels.push_back(file.samples[o * outer_stride + r * row_stride + c * column_stride]);
  return pixels;
}

double thickness_of(const NrrdFile &file, const Roles &roles)
{
  if (roles.slice < 0)
    throw InputError(file.where + " has no slice axis, which says how thick the slice is; save it with a third spatial "
                                  "axis of size 1.");
  const NrrdAxis &slice = axis_at(file, roles.slice);
  return slice.thickness && *slice.thickness > 0 ? *slice.thickness : slice.step->norm();
}

std::vector<double> times_of(const NrrdFile &file, int time_axis)
{
  const std::string key = fmt::format("axis {} index values", time_axis);
  const auto found = file.header.values.find(key);
  if (found == file.header.values.end())
    throw InputError(fmt::format("{} does not say when its frames were taken; add '{}:=' and one time a frame, in "
                                 "seconds, to the header.",
                                 file.where, key));
  std::istringstream words(found->second);
  std::vector<double> times;
  for (std::string word; words >> word;)
    if (const auto time = number_of(word))
      times.push_back(*time);
    else
      throw InputError(
          fmt::format("{} has '{}' among its frame times, but numbers are needed, in seconds; correct '{}'.",
                      file.where, word, key));
  if (times.size() != axis_at(file, time_axis).size)
    throw InputError(fmt::format("{} has {} frames but {} frame times; correct '{}'.", file.where,
                                 axis_at(file, time_axis).size, times.size(), key));
  return times;
}
} // namespace

ImageSeries read_nrrd_series(const std::filesystem::path &file)
{
  const NrrdFile opened_file = opened(file);
  const Roles roles = roles_of(opened_file, true);
  if (roles.time < 0)
    throw InputError(opened_file.where + " has no time axis (one without a space direction), but a dynamic series is "
                                         "needed; save it as a sequence.");
  ImageSeries series;
  series.geometry = geometry_of(opened_file, roles);
  series.slice_thickness_mm = thickness_of(opened_file, roles);
  series.times_s = times_of(opened_file, roles.time);
  series.pixels = arranged(opened_file, roles, roles.time);
  series.description = opened_file.header.content;
  check(series, opened_file.where);
  return series;
}

ImageVolume read_nrrd_volume(const std::filesystem::path &file)
{
  const NrrdFile opened_file = opened(file);
  const Roles roles = roles_of(opened_file, false);
  if (roles.time >= 0)
    throw InputError(opened_file.where + " has a time axis, but a stack of slices at one instant is needed; save one "
                                         "instant alone.");
  ImageVolume volume;
  volume.geometry = geometry_of(opened_file, roles);
  volume.slice_thickness_mm = thickness_of(opened_file, roles);
  volume.slice_step = *axis_at(opened_file, roles.slice).step;
  volume.slices = static_cast<int>(axis_at(opened_file, roles.slice).size);
  volume.pixels = arranged(opened_file, roles, roles.slice);
  volume.description = opened_file.header.content;
  check(volume, opened_file.where);
  return volume;
}
} // namespace pelvireg::observation
