#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/dicom_series.h"
#include "synthetic/observation/images/image_checks.h"
#include "synthetic/observation/images/nrrd_header.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gdcmImageReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector3d;

constexpr double position_tolerance = 0.01; ///< mm, for what is written with a few digits

/// One file of a series.
struct DicomImage
{
  std::string where;
  std::string series_uid, description;
  dataset::ImageGeometry geometry;
  double thickness = 0;
  std::optional<double> trigger_ms, acquisition_s, content_s;
  std::vector<float> pixels;
};

/// The text of a field without padding; empty when it is not there.
std::string text_at(const gdcm::DataSet &set, std::uint16_t group, std::uint16_t element)
{
  const gdcm::Tag tag(group, element);
  if (!set.FindDataElement(tag) || set.GetDataElement(tag).IsEmpty())
    return "";
  const gdcm::ByteValue *value = set.GetDataElement(tag).GetByteValue();
  if (!value)
    return "";
  std::string text(value->GetPointer(), value->GetLength());
  const auto is_padding = [](char c) { return c == ' ' || c == '\0'; };
  while (!text.empty() && is_padding(text.back()))
    text.pop_back();
  while (!text.empty() && is_padding(text.front()))
    text.erase(text.begin());
  return text;
}

/// Numbers between backslashes.
std::vector<double> numbers_at(const gdcm::DataSet &set, std::uint16_t group, std::uint16_t element,
                               const std::string &name, std::size_t n, const std::string &where)
{
  std::string text = text_at(set, group, element);
  std::replace(text.begin(), text.end(), '\\', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;)
  {
    if (word.front() == '+')
      word.erase(0, 1);
    const auto number = number_of(word);
    numbers.push_back(number && std::isfinite(*number) ? *number : std::nan(""));
  }
  if (numbers.size() != n || std::any_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }))
    throw InputError(
        fmt::format("{} has '{}' as its {} ({:04X},{:04X}), but {} number{} needed; give the images as the "
                    "scanner wrote them.",
                    where, text, name, group, element, n, n == 1 ? " is" : "s are"));
  return numbers;
}

/// Seconds since midnight of HHMMSS.FFFFFF, or none.
std::optional<double> seconds_at(const gdcm::DataSet &set, std::uint16_t group, std::uint16_t element)
{
  const std::string text = text_at(set, group, element);
  if (text.size() < 6)
    return {};
  const auto hours = number_of(text.substr(0, 2)), minutes = number_of(text.substr(2, 2)),
             seconds = number_of(text.substr(4));
  if (!hours || !minutes || !seconds)
    return {};
  return 3600 * *hours + 60 * *minutes + *seconds;
}

template <typename Stored>
void rescale(const std::vector<char> &bytes, double slope, double intercept, std::vector<float> &pixels)
{
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    pixels[i] = static_cast<float>(slope * stored + intercept);
  }
}

std::vector<float> pixels_of(const gdcm::Image &image, const gdcm::DataSet &set, const std::string &where)
{
  const gdcm::PixelFormat &format = image.GetPixelFormat();
  std::vector<float> pixels(static_cast<std::size_t>(image.GetDimension(0)) * image.GetDimension(1));
  std::vector<char> bytes(image.GetBufferLength());
  if (bytes.size() != pixels.size() * format.GetPixelSize() || !image.GetBuffer(bytes.data()))
    throw InputError(where + " has pixels that cannot be decoded, or too few; copy it again.");
  const bool is_rescaled = !text_at(set, 0x0028, 0x1053).empty();
  const double slope = is_rescaled ? numbers_at(set, 0x0028, 0x1053, "rescale slope", 1, where)[0] : 1;
  const double intercept = is_rescaled ? numbers_at(set, 0x0028, 0x1052, "rescale intercept", 1, where)[0] : 0;
  switch (format.GetScalarType())
  {
  case gdcm::PixelFormat::UINT8:
    rescale<std::uint8_t>(bytes, slope, intercept, pixels);
    break;
  case gdcm::PixelFormat::INT8:
    rescale<std::int8_t>(bytes, slope, intercept, pixels);
    break;
  case gdcm::PixelFormat::UINT12:
  case gdcm::PixelFormat::UINT16:
    rescale<std::uint16_t>(bytes, slope, intercept, pixels);
    break;
  case gdcm::PixelFormat::INT12:
  case gdcm::PixelFormat::INT16:
    rescale<std::int16_t>(bytes, slope, intercept, pixels);
    break;
  default:
    throw InputError(fmt::format("{} has pixels of type {}, but 8 and 16 bit integers are understood; convert it.",
                                 where, format.GetScalarTypeAsString()));
  }
  return pixels;
}

void check_kind(const gdcm::Image &image, const gdcm::DataSet &set, const std::string &where)
{
  if (const std::string kind = text_at(set, 0x0008, 0x0016); kind != mr_image_storage)
    throw InputError(
        fmt::format("{} is of SOP class '{}', but MR Image Storage ({}) is needed; give the MR series, one "
                    "frame a file.",
                    where, kind, mr_image_storage));
  if (image.GetPixelFormat().GetSamplesPerPixel() != 1 ||
      image.GetPhotometricInterpretation() != gdcm::PhotometricInterpretation::MONOCHROME2)
    throw InputError(
        fmt::format("{} is {} with {} value(s) a pixel, but grey images (MONOCHROME2) are needed; give the "
                    "images as the scanner wrote them.",
                    where, text_at(set, 0x0028, 0x0004), image.GetPixelFormat().GetSamplesPerPixel()));
  if (image.GetNumberOfDimensions() > 2 && image.GetDimension(2) != 1)
    throw InputError(
        fmt::format("{} holds {} frames, but one a file is needed; split it.", where, image.GetDimension(2)));
}

dataset::ImageGeometry geometry_of(const gdcm::Image &image, const gdcm::DataSet &set, const std::string &where)
{
  const auto position = numbers_at(set, 0x0020, 0x0032, "image position", 3, where);
  const auto orientation = numbers_at(set, 0x0020, 0x0037, "image orientation", 6, where);
  const auto spacing = numbers_at(set, 0x0028, 0x0030, "pixel spacing", 2, where);
  dataset::ImageGeometry geometry;
  geometry.origin = Vector3d(position[0], position[1], position[2]);
  geometry.column_direction = Vector3d(orientation[0], orientation[1], orientation[2]);
  geometry.row_direction = Vector3d(orientation[3], orientation[4], orientation[5]);
  geometry.spacing = {spacing[1], spacing[0]};
  geometry.columns = static_cast<int>(image.GetDimension(0));
  geometry.rows = static_cast<int>(image.GetDimension(1));
  return geometry;
}

/// GDCM takes a file that ends within its pixels. No element is shorter in a file than its value and 8 bytes, and that
/// of pixels in explicit VR has 4 more; the preamble, where there is one, has
/// 132.
void check_length(const std::filesystem::path &file, const gdcm::File &content, const std::string &where)
{
  const gdcm::TransferSyntax syntax = content.GetHeader().GetDataSetTransferSyntax();
  if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
    return;
  std::uintmax_t least = content.GetHeader().IsEmpty() ? 0 : 132;
  for (const gdcm::DataElement &element : content.GetHeader().GetDES())
    least += 8 + (element.GetByteValue() ? static_cast<std::uintmax_t>(element.GetByteValue()->GetLength()) : 0);
  for (const gdcm::DataElement &element : content.GetDataSet().GetDES())
    least += 8 + (element.GetByteValue() ? static_cast<std::uintmax_t>(element.GetByteValue()->GetLength()) : 0);
  if (syntax.IsExplicit())
    least += 4;
  if (std::filesystem::file_size(file) < least)
    throw InputError(fmt::format("{} ends too soon: it has {} bytes, but its fields need {}; copy it again.", where,
                                 std::filesystem::file_size(file), least));
}

DicomImage image_in(const std::filesystem::path &file)
{
  DicomImage image;
  image.where = fmt::format("The DICOM file '{}'", file.string());
  gdcm::ImageReader reader;
  reader.SetFileName(file.c_str());
  if (!reader.Read())
    throw InputError(image.where + " cannot be read as a DICOM image (damaged, or something else); remove it from the "
                                   "folder or copy it again.");
  check_length(file, reader.GetFile(), image.where);
  const gdcm::DataSet &set = reader.GetFile().GetDataSet();
  check_kind(reader.GetImage(), set, image.where);
  image.geometry = geometry_of(reader.GetImage(), set, image.where);
  image.series_uid = text_at(set, 0x0020, 0x000E);
  image.description = text_at(set, 0x0008, 0x103E);
  image.thickness = numbers_at(set, 0x0018, 0x0050, "slice thickness", 1, image.where)[0];
  if (!text_at(set, 0x0018, 0x1060).empty())
    image.trigger_ms = numbers_at(set, 0x0018, 0x1060, "trigger time", 1, image.where)[0];
  image.acquisition_s = seconds_at(set, 0x0008, 0x0032);
  image.content_s = seconds_at(set, 0x0008, 0x0033);
  image.pixels = pixels_of(reader.GetImage(), set, image.where);
  return image;
}

/// Same series, size, spacing, directions and thickness.
void check_belongs(const DicomImage &first, const DicomImage &other)
{
  if (other.series_uid != first.series_uid)
    throw InputError(fmt::format("{} is of another series than {}, but a folder with one series is needed; put each "
                                 "series into a folder of its own.",
                                 other.where, first.where));
  const dataset::ImageGeometry &a = first.geometry, &b = other.geometry;
  if (a.columns != b.columns || a.rows != b.rows)
    throw InputError(fmt::format("{} has {} x {} pixels but {} has {} x {}, and all must have the same; give images of "
                                 "one size.",
                                 other.where, b.columns, b.rows, first.where, a.columns, a.rows));
  const double difference =
      std::max({std::abs(a.spacing[0] - b.spacing[0]), std::abs(a.spacing[1] - b.spacing[1]),
                (a.column_direction - b.column_direction).norm(), (a.row_direction - b.row_direction).norm(),
                std::abs(first.thickness - other.thickness)});
  if (!(difference <= 1e-3))
    throw InputError(fmt::format("{} has another pixel spacing, orientation or slice thickness than {}, and all must "
                                 "have the same; give one plane's images.",
                                 other.where, first.where));
}

std::vector<DicomImage> images_in(const std::filesystem::path &folder)
{
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        entry.is_regular_file() && name.front() != '.' && name != "DICOMDIR")
      files.push_back(entry.path());
  if (files.empty())
    throw InputError(fmt::format("The folder '{}' holds no file, but a DICOM series is needed; give another folder.",
                                 folder.string()));
  std::sort(files.begin(), files.end());
  std::vector<DicomImage> images;
  for (const std::filesystem::path &file : files)
  {
    images.push_back(image_in(file));
    check_belongs(images.front(), images.back());
  }
  return images;
}

/// From the first kind of time that all files have and in which they differ.
std::vector<double> times_of(const std::vector<DicomImage> &images, const std::string &where)
{
  const auto times_by = [&](auto &&time_of) -> std::vector<double>
  {
    std::vector<double> times;
    for (const DicomImage &image : images)
      if (const std::optional<double> time = time_of(image))
        times.push_back(*time);
      else
        return {};
    const auto [least, most] = std::minmax_element(times.begin(), times.end());
    return images.size() > 1 && *least == *most ? std::vector<double>{} : times;
  };
  std::vector<double> times =
      times_by([](const DicomImage &image) -> std::optional<double>
               { return image.trigger_ms ? std::optional(*image.trigger_ms / 1000) : std::nullopt; });
  if (!times.empty())
    return times;
  times = times_by([](const DicomImage &image) { return image.acquisition_s; });
  if (times.empty())
    times = times_by([](const DicomImage &image) { return image.content_s; });
  if (times.empty())
    throw InputError(where + " does not say when its frames were taken: trigger, acquisition and content times are "
                             "missing or all the same; give a dynamic series.");
  const double first = *std::min_element(times.begin(), times.end());
  for (double &time : times)
    time -= first;
  return times;
}

/// Positions in the order of `keys`.
std::vector<std::size_t> order_of(const std::vector<double> &keys)
{
  std::vector<std::size_t> order(keys.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}
} // namespace

dataset::ImageSeries read_dicom_series(const std::filesystem::path &folder)
{
  const std::string where = fmt::format("The DICOM series in '{}'", folder.string());
  const std::vector<DicomImage> images = images_in(folder);
  for (const DicomImage &image : images)
    if (!((image.geometry.origin - images.front().geometry.origin).norm() <= position_tolerance))
      throw InputError(fmt::format("{} lies elsewhere than {}, but a dynamic series of one plane is needed; give one "
                                   "plane's images.",
                                   image.where, images.front().where));
  const std::vector<double> times = times_of(images, where);
  const std::vector<std::size_t> order = order_of(times);
  dataset::ImageSeries series{.geometry = images.front().geometry,
                              .slice_thickness_mm = images.front().thickness,
                              .times_s = {},
                              .pixels = {},
                              .description = images.front().description};
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i > 0 && times[order[i]] == times[order[i - 1]])
      throw InputError(fmt::format("{} and {} were taken at the same time, {} s, but each frame needs its own; remove "
                                   "one.",
                                   images[order[i - 1]].where, images[order[i]].where, times[order[i]]));
    series.times_s.push_back(times[order[i]]);
    series.pixels.insert(series.pixels.end(), images[order[i]].pixels.begin(), images[order[i]].pixels.end());
  }
  check(series, where);
  return series;
}

dataset::ImageVolume read_dicom_volume(const std::filesystem::path &folder)
{
  const std::string where = fmt::format("The DICOM series in '{}'", folder.string());
  const std::vector<DicomImage> images = images_in(folder);
  const dataset::ImageGeometry &any = images.front().geometry;
  const Vector3d normal = any.column_direction.cross(any.row_direction);
  std::vector<double> places;
  for (const DicomImage &image : images)
    places.push_back(image.geometry.origin.dot(normal));
  const std::vector<std::size_t> order = order_of(places);
  dataset::ImageVolume volume{.geometry = images[order.front()].geometry,
                              .slice_step = images.front().thickness * normal,
                              .slices = static_cast<int>(images.size()),
                              .slice_thickness_mm = images.front().thickness,
                              .pixels = {},
                              .description = images.front().description};
  if (images.size() > 1)
    volume.slice_step =
        (images[order.back()].geometry.origin - volume.geometry.origin) / static_cast<double>(images.size() - 1);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const DicomImage &image = images[order[i]];
    const Vector3d expected = volume.geometry.origin + static_cast<double>(i) * volume.slice_step;
    if (!((image.geometry.origin - expected).norm() <= position_tolerance))
      throw InputError(
          fmt::format("{} does not lie at an even distance from its neighbours, but a whole stack is needed; "
                      "give all its slices, each once.",
                      image.where));
    volume.pixels.insert(volume.pixels.end(), image.pixels.begin(), image.pixels.end());
  }
  check(volume, where);
  return volume;
}
} // namespace pelvireg::observation
