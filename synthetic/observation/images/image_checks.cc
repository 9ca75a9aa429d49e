#include "synthetic/observation/images/image_checks.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace pelvireg::observation
{
namespace
{
constexpr int largest_size = 4096;
constexpr double direction_tolerance = 1e-4; ///< DICOM writes directions with six digits or so

void check(const dataset::ImageGeometry &geometry, const std::string &where)
{
  for (const int size : {geometry.columns, geometry.rows})
    if (size < 2 || size > largest_size)
      throw InputError(fmt::format("{} is {} x {} pixels, but 2 to {} each way are allowed; give another image.", where,
                                   geometry.columns, geometry.rows, largest_size));
  for (const double spacing : geometry.spacing)
    if (!(spacing > 0 && std::isfinite(spacing)))
      throw InputError(fmt::format("{} has a pixel spacing of {} mm, but it must be positive; correct the spacing.",
                                   where, spacing));
  if (!geometry.origin.allFinite())
    throw InputError(where + " has an origin that is not finite; correct it.");
  const double length_error =
      std::max(std::abs(geometry.column_direction.norm() - 1), std::abs(geometry.row_direction.norm() - 1));
  if (!(length_error <= direction_tolerance &&
        std::abs(geometry.column_direction.dot(geometry.row_direction)) <= direction_tolerance))
    throw InputError(where + " has row and column directions that are not perpendicular unit vectors; resample it to a "
                             "rectangular grid.");
}

void check_pixels(const std::vector<float> &pixels, const dataset::ImageGeometry &geometry, std::size_t n_images,
                  const std::string &word, const std::string &where)
{
  const std::size_t image_size = static_cast<std::size_t>(geometry.columns) * static_cast<std::size_t>(geometry.rows);
  if (pixels.size() != n_images * image_size)
    throw InputError(fmt::format("{} holds {} pixels, but {} {}s of {} x {} need {}; write it anew.", where,
                                 pixels.size(), n_images, word, geometry.columns, geometry.rows,
                                 n_images * image_size));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (!std::isfinite(pixels[i]))
      throw InputError(fmt::format("{} has a pixel that is not a finite number, at {} {}, row {}, column {} (from 0); "
                                   "replace it.",
                                   where, word, i / image_size,
                                   i % image_size / static_cast<std::size_t>(geometry.columns),
                                   i % static_cast<std::size_t>(geometry.columns)));
}

void check_thickness(double thickness, const std::string &where)
{
  if (!(thickness > 0 && std::isfinite(thickness)))
    throw InputError(
        fmt::format("{} has a slice thickness of {} mm, but it must be positive; correct it.", where, thickness));
}
} // namespace

void check(const dataset::ImageSeries &series, const std::string &where)
{
  check(series.geometry, where);
  check_thickness(series.slice_thickness_mm, where);
  if (series.times_s.empty())
    throw InputError(where + " has no frame, but at least one is needed; give another image.");
  for (std::size_t i = 0; i < series.times_s.size(); ++i)
    if (!std::isfinite(series.times_s[i]) || (i > 0 && !(series.times_s[i] > series.times_s[i - 1])))
      throw InputError(fmt::format("{} has frame {} at {} s{}, but the frames' times must be finite and increase; "
                                   "correct the times.",
                                   where, i, series.times_s[i],
                                   i > 0 ? fmt::format(" after one at {} s", series.times_s[i - 1]) : ""));
  check_pixels(series.pixels, series.geometry, series.times_s.size(), "frame", where);
}

void check(const dataset::ImageVolume &volume, const std::string &where)
{
  check(volume.geometry, where);
  check_thickness(volume.slice_thickness_mm, where);
  if (volume.slices < 1)
    throw InputError(where + " has no slice, but at least one is needed; give another image.");
  const double step = volume.slice_step.norm();
  const double sheared = std::max(std::abs(volume.slice_step.dot(volume.geometry.column_direction)),
                                  std::abs(volume.slice_step.dot(volume.geometry.row_direction)));
  if (!(step > 0 && std::isfinite(step) && sheared <= 1e-3 * step))
    throw InputError(where + " has slices that do not lie one behind the other along their normal; resample it.");
  check_pixels(volume.pixels, volume.geometry, static_cast<std::size_t>(volume.slices), "slice", where);
}
} // namespace pelvireg::observation
