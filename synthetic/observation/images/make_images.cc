#include "synthetic/observation/images/make_images.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/parallel.h"
#include "synthetic/observation/images/acquisition.h"
#include "synthetic/observation/images/slice_renderer.h"
#include "synthetic/observation/plane_intersection.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <mutex>

namespace pelvireg::observation
{
namespace
{
using dataset::ImageGeometry;
using Eigen::Vector3d;

constexpr double tse_thickness = 5; ///< mm, 1 mm gap

/// Columns to the back, rows down, in a plane of this normal, around `centre`.
ImageGeometry geometry_around(const Vector3d &centre, const Vector3d &normal, int matrix, double pixel)
{
  ImageGeometry geometry;
  geometry.column_direction = (Vector3d::UnitY() - normal.y() * normal).normalized();
  geometry.row_direction = geometry.column_direction.cross(normal);
  geometry.spacing = {pixel, pixel};
  geometry.columns = geometry.rows = matrix;
  const double half = 0.5 * (matrix - 1) * pixel;
  geometry.origin = centre - half * (geometry.column_direction + geometry.row_direction);
  return geometry;
}

/// Middle of the box around the organs' outlines in the plane at rest.
Vector3d centre_of_outlines(const dataset::Anatomy &anatomy, const dataset::Truth &truth)
{
  const ImageGeometry unit = geometry_around(anatomy.dyn_plane.origin, anatomy.dyn_plane.normal, 1, 1);
  Eigen::AlignedBox2d box;
  for (const dataset::TruthSurface &surface : truth.surfaces)
    if (surface.name != "pelvic_floor")
      for (const PlaneLoop &loop : intersect(surface.rest, anatomy.dyn_plane, surface.name))
        for (Eigen::Index i = 0; i < loop.contour.points.rows(); ++i)
          box.extend(to_pixel(unit, loop.contour.points.row(i).transpose()));
  if (box.isEmpty())
    throw InputError("The DYN plane of case " + anatomy.case_name + " meets no organ; move it in the case file.");
  return to_point(unit, box.center().x(), box.center().y());
}

/// Receiver coils in front and behind: brighter near them, 1 in the middle of the field of view.
Raster coil_sensitivity(int rows, int columns)
{
  Raster field(rows, columns);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
    {
      const float u = 2 * (static_cast<float>(column) + 0.5f) / static_cast<float>(columns) - 1;
      const float v = 2 * (static_cast<float>(row) + 0.5f) / static_cast<float>(rows) - 1;
      field(row, column) = std::max(0.3f, 1 + 0.45f * u * u - 0.12f * u + 0.1f * v - 0.25f * v * v);
    }
  return field;
}

AcquisitionSetting acquisition_of(const ImageGeometry &geometry, double snr, double phase_share, std::uint64_t seed)
{
  return {.rows = geometry.rows,
          .columns = geometry.columns,
          .acquired_rows = geometry.rows,
          .acquired_columns = 2 * static_cast<int>(0.5 * phase_share * geometry.columns),
          .oversampling = SliceSetting{}.oversampling,
          .noise = snr > 0 ? bssfp_signals.urine / snr : 0,
          .seed = seed};
}

/// Streams of noise of the three kinds of image.
enum class Noise : std::uint64_t
{
  dyn,
  tse,
  ffe
};

std::uint64_t seed_of(const ImageOptions &options, Noise noise)
{
  return 4 * options.seed + static_cast<std::uint64_t>(noise);
}

void put(const Raster &image, int index, std::vector<float> &pixels)
{
  std::copy(image.data(), image.data() + image.size(), pixels.begin() + index * image.size());
}

dataset::ImageSeries dynamic_series(const std::vector<TissueBody> &bodies, const ImageGeometry &geometry,
                                    const std::string &case_name, std::size_t n_increments, const ImageOptions &options)
{
  dataset::ImageSeries series;
  series.geometry = geometry;
  series.slice_thickness_mm = options.slice_thickness;
  const int n_frames = static_cast<int>(n_increments) * options.frames_per_increment + 1;
  for (int frame = 0; frame < n_frames; ++frame)
    series.times_s.push_back(frame / options.frame_rate);
  series.description = fmt::format("{}, dynamic sagittal bSSFP, SNR {}", case_name, options.snr);
  series.pixels.resize(static_cast<std::size_t>(n_frames) * static_cast<std::size_t>(geometry.rows * geometry.columns));

  const SliceRenderer renderer(bodies, {.geometry = geometry, .thickness = options.slice_thickness}, 0, n_increments);
  const Acquisition scanner(acquisition_of(geometry, options.snr, 0.75, seed_of(options, Noise::dyn)));
  const int factor = SliceSetting{}.oversampling;
  const Raster coil = coil_sensitivity(geometry.rows * factor, geometry.columns * factor);
  std::atomic<int> done = 0;
  std::mutex mutex;
  dataset::for_each_index(n_frames, options.n_threads,
                          [&](int frame)
                          {
                            std::vector<Raster> instants;
                            for (int i = 0; i < options.segments; ++i)
                            {
                              const double at = frame + (i + 0.5) / options.segments - 0.5; // in frames
                              instants.push_back(coil * renderer.at(at / options.frames_per_increment));
                            }
                            put(scanner.acquire(instants, static_cast<std::uint32_t>(frame)), frame, series.pixels);
                            ++done;
                            const std::lock_guard lock(mutex);
                            if (options.progress)
                              options.progress(0.85 * done / n_frames,
                                               fmt::format("frame {} of {}", done.load(), n_frames));
                          });
  return series;
}

struct StackSetting
{
  ImageGeometry geometry; ///< of the middle slice
  double thickness = 6;
  TissueSignals signals = bssfp_signals;
  std::size_t increment = 0;
  Noise noise = Noise::ffe;
  std::string description;
};

dataset::ImageVolume stack_of(const std::vector<TissueBody> &bodies, const dataset::Anatomy &anatomy,
                              const StackSetting &setting, const ImageOptions &options)
{
  dataset::ImageVolume volume;
  volume.geometry = setting.geometry;
  volume.slice_step = anatomy.slice_pitch * anatomy.dyn_plane.normal;
  volume.geometry.origin -= anatomy.n_slices_each_side * volume.slice_step;
  volume.slices = 2 * anatomy.n_slices_each_side + 1;
  volume.slice_thickness_mm = setting.thickness;
  volume.description = setting.description;
  const int image_size = setting.geometry.rows * setting.geometry.columns;
  volume.pixels.resize(static_cast<std::size_t>(volume.slices) * static_cast<std::size_t>(image_size));
  const Acquisition scanner(acquisition_of(setting.geometry, options.static_snr, 0.9, seed_of(options, setting.noise)));
  const int factor = SliceSetting{}.oversampling;
  const Raster coil = coil_sensitivity(setting.geometry.rows * factor, setting.geometry.columns * factor);
  dataset::for_each_index(
      volume.slices, options.n_threads,
      [&](int slice)
      {
        SliceSetting one{.geometry = volume.geometry, .thickness = setting.thickness, .signals = setting.signals};
        one.geometry.origin += slice * volume.slice_step;
        const SliceRenderer renderer(bodies, one, setting.increment, setting.increment);
        const Raster ideal = coil * renderer.at(static_cast<double>(setting.increment));
        put(scanner.acquire({ideal}, static_cast<std::uint32_t>(slice)), slice, volume.pixels);
      });
  return volume;
}

void check(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const ImageOptions &options)
{
  if (const auto violations = options.violations(); !violations.empty())
    throw InputError(violations.front());
  if (anatomy.case_name != truth.case_name)
    throw InputError("The anatomy is of case " + anatomy.case_name + " and the truth of case " + truth.case_name +
                     ": they must be of one case; run `pelvireg reference` in this directory again.");
}
} // namespace

std::vector<std::string> ImageOptions::violations() const
{
  std::vector<std::string> problems;
  const auto require = [&](const char *name, double value, double least, double most, bool or_zero = false)
  {
    if (!((value >= least && value <= most) || (or_zero && value == 0)))
      problems.push_back(fmt::format("images: {} is {}, but {} to {}{} is allowed; change it.", name, value, least,
                                     most, or_zero ? ", or 0 for no noise," : ""));
  };
  require("the matrix", matrix, 64, 512);
  require("the pixel (mm)", pixel, 0.5, 4);
  require("the slice thickness (mm)", slice_thickness, 2, 12);
  require("the signal-to-noise ratio", snr, 1, 1000, true);
  require("the signal-to-noise ratio of the static images", static_snr, 1, 1000, true);
  require("the frame rate (1/s)", frame_rate, 0.5, 10);
  require("the number of frames an increment", frames_per_increment, 1, 12);
  require("the number of instants within a frame", segments, 1, 15);
  if (segments % 2 == 0)
    problems.push_back(
        fmt::format("images: the number of instants within a frame is {}, but it must be odd, so that one "
                    "lies at the frame's time; change it.",
                    segments));
  if (matrix % 2 != 0)
    problems.push_back(fmt::format("images: the matrix is {}, but it must be even; change it.", matrix));
  return problems;
}

ImageGeometry dynamic_geometry(const dataset::Anatomy &anatomy, const dataset::Truth &truth,
                               const ImageOptions &options)
{
  return geometry_around(centre_of_outlines(anatomy, truth), anatomy.dyn_plane.normal, options.matrix, options.pixel);
}

Images make_images(const dataset::Anatomy &anatomy, const dataset::Truth &truth, const ImageOptions &options)
{
  check(anatomy, truth, options);
  const std::vector<TissueBody> bodies = tissue_bodies(anatomy, truth);
  const ImageGeometry geometry = dynamic_geometry(anatomy, truth, options);
  const std::size_t n_increments = truth.increments.size();
  Images images;
  images.dyn = dynamic_series(bodies, geometry, truth.case_name, n_increments, options);
  const auto say = [&](double fraction, const std::string &message)
  {
    if (options.progress)
      options.progress(fraction, message);
  };
  say(0.85, "TSE volume");
  images.tse = stack_of(bodies, anatomy,
                        {.geometry = geometry_around(centre_of_outlines(anatomy, truth), anatomy.dyn_plane.normal,
                                                     options.matrix * 3 / 2, options.pixel / 2),
                         .thickness = std::min(tse_thickness, anatomy.slice_pitch),
                         .signals = tse_signals,
                         .increment = 0,
                         .noise = Noise::tse,
                         .description = truth.case_name + ", sagittal TSE at rest"},
                        options);
  say(0.95, "FFE slices");
  images.ffe = stack_of(bodies, anatomy,
                        {.geometry = geometry,
                         .thickness = anatomy.slice_pitch,
                         .signals = bssfp_signals,
                         .increment = n_increments,
                         .noise = Noise::ffe,
                         .description = truth.case_name + ", sagittal FFE at the last increment"},
                        options);
  return images;
}
} // namespace pelvireg::observation
