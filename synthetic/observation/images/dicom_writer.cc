#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/content_uid.h"
#include "synthetic/observation/images/dicom_series.h"
#include "synthetic/observation/images/image_checks.h"
#include "synthetic/observation/images/image_files.h"

#include <fmt/format.h>
#include <gdcmDataElement.h>
#include <gdcmFile.h>
#include <gdcmTag.h>
#include <gdcmTrace.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unistd.h>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector3d;

/// What all images of a series share.
struct Series
{
  const dataset::ImageGeometry &geometry;
  double thickness, slice_distance;
  std::string study, description;
  std::string study_uid, series_uid, frame_of_reference_uid;
  double slope, intercept;
  std::size_t n_images;
};

/// A decimal string has at most 16 characters.
std::string decimal(double value)
{
  for (int digits = 15; digits > 0; --digits)
    if (std::string text = fmt::format("{:.{}g}", value, digits); text.size() <= 16)
      return text;
  throw InputError(fmt::format("The number {} has no DICOM text; correct the image.", value));
}

std::string decimals(const Vector3d &vector)
{
  return decimal(vector.x()) + "\\" + decimal(vector.y()) + "\\" + decimal(vector.z());
}

void put(gdcm::DataSet &set, std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, std::string text)
{
  if (text.size() % 2 == 1)
    text += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement field(gdcm::Tag(group, element));
  field.SetVR(vr);
  field.SetByteValue(text.data(), static_cast<std::uint32_t>(text.size()));
  set.Replace(field);
}

void put_number(gdcm::DataSet &set, std::uint16_t group, std::uint16_t element, std::uint16_t value)
{
  const char bytes[2] = {static_cast<char>(value & 0xFF), static_cast<char>(value >> 8)};
  gdcm::DataElement field(gdcm::Tag(group, element));
  field.SetVR(gdcm::VR::US);
  field.SetByteValue(bytes, 2);
  set.Replace(field);
}

void put_identity(gdcm::DataSet &set, const Series &series, std::size_t index)
{
  using gdcm::VR;
  put(set, 0x0008, 0x0008, VR::CS, "DERIVED\\SECONDARY\\OTHER");
  put(set, 0x0008, 0x0016, VR::UI, mr_image_storage);
  put(set, 0x0008, 0x0018, VR::UI, content_uid(series.series_uid + fmt::format(" image {}", index)));
  put(set, 0x0008, 0x0020, VR::DA, "");
  put(set, 0x0008, 0x0030, VR::TM, "");
  put(set, 0x0008, 0x0050, VR::SH, "");
  put(set, 0x0008, 0x0060, VR::CS, "MR");
  put(set, 0x0008, 0x0070, VR::LO, "pelvireg");
  put(set, 0x0008, 0x0090, VR::PN, "");
  put(set, 0x0008, 0x103E, VR::LO, series.description.substr(0, 64));
  put(set, 0x0010, 0x0010, VR::PN, "synthetic^" + series.study.substr(0, 50));
  put(set, 0x0010, 0x0020, VR::LO, series.study.substr(0, 64));
  put(set, 0x0010, 0x0030, VR::DA, "");
  put(set, 0x0010, 0x0040, VR::CS, "F");
  put(set, 0x0020, 0x000D, VR::UI, series.study_uid);
  put(set, 0x0020, 0x000E, VR::UI, series.series_uid);
  put(set, 0x0020, 0x0010, VR::SH, "");
  put(set, 0x0020, 0x0011, VR::IS, "1");
  put(set, 0x0020, 0x0013, VR::IS, std::to_string(index + 1));
  put(set, 0x0020, 0x0052, VR::UI, series.frame_of_reference_uid);
  put(set, 0x0020, 0x1040, VR::LO, "");
}

/// DICOM's "row" direction is that of increasing columns, and its pixel spacing begins with the step between rows.
void put_geometry(gdcm::DataSet &set, const Series &series, const Vector3d &origin)
{
  using gdcm::VR;
  const dataset::ImageGeometry &geometry = series.geometry;
  put(set, 0x0018, 0x0020, VR::CS, "GR");
  put(set, 0x0018, 0x0021, VR::CS, "NONE");
  put(set, 0x0018, 0x0022, VR::CS, "");
  put(set, 0x0018, 0x0023, VR::CS, "2D");
  put(set, 0x0018, 0x0050, VR::DS, decimal(series.thickness));
  put(set, 0x0018, 0x0081, VR::DS, "");
  put(set, 0x0018, 0x0088, VR::DS, decimal(series.slice_distance));
  put(set, 0x0018, 0x0091, VR::IS, "");
  put(set, 0x0018, 0x5100, VR::CS, "HFS");
  put(set, 0x0020, 0x0032, VR::DS, decimals(origin));
  put(set, 0x0020, 0x0037, VR::DS, decimals(geometry.column_direction) + "\\" + decimals(geometry.row_direction));
  put(set, 0x0028, 0x0030, VR::DS, decimal(geometry.spacing[1]) + "\\" + decimal(geometry.spacing[0]));
}

void put_time(gdcm::DataSet &set, const Series &series, std::size_t index, double time_s)
{
  using gdcm::VR;
  const double seconds = std::fmod(time_s, 60), minutes = std::floor(time_s / 60);
  put(set, 0x0008, 0x0032, VR::TM,
      fmt::format("{:02}{:02}{:09.6f}", static_cast<int>(minutes) / 60, static_cast<int>(minutes) % 60, seconds));
  put(set, 0x0018, 0x1060, VR::DS, decimal(1000 * time_s));
  put(set, 0x0020, 0x0100, VR::IS, std::to_string(index + 1));
  put(set, 0x0020, 0x0105, VR::IS, std::to_string(series.n_images));
}

void put_pixels(gdcm::DataSet &set, const Series &series, const float *pixels)
{
  using gdcm::VR;
  const std::size_t n =
      static_cast<std::size_t>(series.geometry.columns) * static_cast<std::size_t>(series.geometry.rows);
  put_number(set, 0x0028, 0x0002, 1);
  put(set, 0x0028, 0x0004, VR::CS, "MONOCHROME2");
  put_number(set, 0x0028, 0x0010, static_cast<std::uint16_t>(series.geometry.rows));
  put_number(set, 0x0028, 0x0011, static_cast<std::uint16_t>(series.geometry.columns));
  put_number(set, 0x0028, 0x0100, 16);
  put_number(set, 0x0028, 0x0101, 16);
  put_number(set, 0x0028, 0x0102, 15);
  put_number(set, 0x0028, 0x0103, 0);
  put(set, 0x0028, 0x1052, VR::DS, decimal(series.intercept));
  put(set, 0x0028, 0x1053, VR::DS, decimal(series.slope));
  put(set, 0x0028, 0x1054, VR::LO, "US");
  std::vector<char> bytes;
  bytes.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double stored = std::round((static_cast<double>(pixels[i]) - series.intercept) / series.slope);
    const std::uint16_t value = static_cast<std::uint16_t>(std::clamp(stored, 0.0, 65535.0)); // round-off alone
    bytes.push_back(static_cast<char>(value & 0xFF));
    bytes.push_back(static_cast<char>(value >> 8));
  }
  gdcm::DataElement field(gdcm::Tag(0x7FE0, 0x0010));
  field.SetVR(VR::OW);
  field.SetByteValue(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  set.Replace(field);
}

void write_image(const Series &series, std::size_t index, const Vector3d &origin, std::optional<double> time_s,
                 const float *pixels, const std::filesystem::path &file)
{
  gdcm::Writer writer;
  gdcm::DataSet &set = writer.GetFile().GetDataSet();
  put_identity(set, series, index);
  put_geometry(set, series, origin);
  if (time_s)
    put_time(set, series, index, *time_s);
  put_pixels(set, series, pixels);
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  writer.SetFileName(file.c_str());
  if (!writer.Write())
    throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
}

Series series_of(const dataset::ImageGeometry &geometry, double thickness, double slice_distance,
                 const std::string &study, const std::string &description, const std::vector<float> &pixels,
                 std::size_t n_images)
{
  const auto [least, most] = std::minmax_element(pixels.begin(), pixels.end());
  const double intercept = std::stod(decimal(std::min(0.0, static_cast<double>(*least))));
  double slope = (static_cast<double>(*most) - intercept) / 65535;
  if (!(slope > 0))
    slope = 1; // all pixels are equal
  const std::string bytes(reinterpret_cast<const char *>(pixels.data()), pixels.size() * sizeof(float));
  return {.geometry = geometry,
          .thickness = thickness,
          .slice_distance = slice_distance,
          .study = study,
          .description = description,
          .study_uid = content_uid("study " + study),
          .series_uid = content_uid("series " + study + " " + description + " " + bytes),
          .frame_of_reference_uid = content_uid("frame of reference " + study),
          .slope = std::stod(decimal(slope)),
          .intercept = intercept,
          .n_images = n_images};
}

/// Fills a folder of another name and puts it in the place of `folder`.
template <typename Fill> void replace_folder(const std::filesystem::path &folder, const Fill &fill)
{
  gdcm::Trace::WarningOff();
  const std::filesystem::path unfinished = folder.string() + "." + std::to_string(::getpid()) + ".tmp";
  try
  {
    std::filesystem::create_directories(unfinished);
    fill(unfinished);
    std::filesystem::remove_all(folder);
    std::filesystem::rename(unfinished, folder);
  }
  catch (const std::exception &)
  {
    std::error_code ignored;
    std::filesystem::remove_all(unfinished, ignored);
    throw;
  }
}
} // namespace

void write_dicom(const dataset::ImageSeries &images, const std::string &study, const std::filesystem::path &folder)
{
  check(images, fmt::format("The image for '{}'", folder.string()));
  const std::size_t n = images.times_s.size(), size = images.pixels.size() / n;
  const Series series = series_of(images.geometry, images.slice_thickness_mm, images.slice_thickness_mm, study,
                                  images.description, images.pixels, n);
  replace_folder(folder,
                 [&](const std::filesystem::path &place)
                 {
                   for (std::size_t i = 0; i < n; ++i)
                     write_image(series, i, images.geometry.origin, images.times_s[i], images.pixels.data() + i * size,
                                 place / fmt::format("{:04}.dcm", i + 1));
                 });
}

void write_dicom(const dataset::ImageVolume &volume, const std::string &study, const std::filesystem::path &folder)
{
  check(volume, fmt::format("The image for '{}'", folder.string()));
  const std::size_t n = static_cast<std::size_t>(volume.slices), size = volume.pixels.size() / n;
  const Series series = series_of(volume.geometry, volume.slice_thickness_mm, volume.slice_step.norm(), study,
                                  volume.description, volume.pixels, n);
  replace_folder(folder,
                 [&](const std::filesystem::path &place)
                 {
                   for (std::size_t i = 0; i < n; ++i)
                     write_image(series, i, volume.geometry.origin + static_cast<double>(i) * volume.slice_step, {},
                                 volume.pixels.data() + i * size, place / fmt::format("{:04}.dcm", i + 1));
                 });
}
} // namespace pelvireg::observation
