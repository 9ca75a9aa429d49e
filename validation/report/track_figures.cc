#include "validation/report/track_figures.h"

#include "synthetic/dataset/atomic_file.h"
#include "synthetic/dataset/error.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace pelvireg::report
{
namespace
{
using Colour = std::array<double, 3>;
using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

constexpr int enlargement = 3;
constexpr double margin = 15;       // mm
constexpr int gap = 6;              // px between two frames
constexpr double line_radius = 0.9; // px of the figure
constexpr double dash = 7;          // px drawn, and as many left out

/// The colours of the paper's figure 4.
Colour colour_of(const OverlayOutline &outline)
{
  if (outline.is_dashed)
    return {255, 255, 255};
  const std::array<Colour, 4> colours = {Colour{235, 60, 50}, {70, 120, 255}, {60, 215, 235}, {60, 200, 80}};
  const auto found = std::find(dataset::organ_names.begin(), dataset::organ_names.end(), outline.organ);
  return colours[static_cast<std::size_t>(found - dataset::organ_names.begin()) % colours.size()];
}

/// Column and row in the image.
Pixels in_image(const dataset::ImageGeometry &geometry, const dataset::Points &points)
{
  const dataset::Points from_origin = points.rowwise() - geometry.origin.transpose();
  Pixels pixels(points.rows(), 2);
  pixels.col(0) = from_origin * geometry.column_direction / geometry.spacing[0];
  pixels.col(1) = from_origin * geometry.row_direction / geometry.spacing[1];
  return pixels;
}

struct Window
{
  int column = 0, row = 0, columns = 0, rows = 0; ///< of the image
};

Window window_of(const dataset::ImageGeometry &geometry, const std::vector<OverlayFrame> &frames)
{
  Eigen::Vector2d low(geometry.columns, geometry.rows), high(0, 0);
  for (const OverlayFrame &frame : frames)
    for (const OverlayOutline &outline : frame.outlines)
    {
      const Pixels pixels = in_image(geometry, outline.points);
      low = low.cwiseMin(pixels.colwise().minCoeff().transpose());
      high = high.cwiseMax(pixels.colwise().maxCoeff().transpose());
    }
  const Eigen::Vector2d room(margin / geometry.spacing[0], margin / geometry.spacing[1]);
  low = (low - room).cwiseMax(0);
  high = (high + room).cwiseMin(Eigen::Vector2d(geometry.columns - 1, geometry.rows - 1)).cwiseMax(low);
  return {static_cast<int>(low.x()), static_cast<int>(low.y()),
          static_cast<int>(high.x()) - static_cast<int>(low.x()) + 1,
          static_cast<int>(high.y()) - static_cast<int>(low.y()) + 1};
}

/// The picture, rows from the top.
struct Canvas
{
  int width, height;
  std::vector<Colour> pixels;

  Canvas(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Colour &at(int x, int y)
  {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }

  void dot(const Eigen::Vector2d &centre, const Colour &colour)
  {
    const int reach = static_cast<int>(std::ceil(line_radius)) + 1;
    const int x0 = static_cast<int>(centre.x()), y0 = static_cast<int>(centre.y());
    for (int y = std::max(0, y0 - reach); y <= std::min(height - 1, y0 + reach); ++y)
      for (int x = std::max(0, x0 - reach); x <= std::min(width - 1, x0 + reach); ++x)
      {
        const double cover = std::clamp(line_radius + 0.5 - std::hypot(x - centre.x(), y - centre.y()), 0.0, 1.0);
        for (std::size_t k = 0; k < 3; ++k)
          at(x, y)[k] = std::max(cover * colour[k] + (1 - cover) * at(x, y)[k], cover > 0.9 ? colour[k] : 0.0);
      }
  }
};

void draw_pixels(Canvas &canvas, const dataset::ImageSeries &series, int frame, const Window &window, int left)
{
  const dataset::ImageGeometry &geometry = series.geometry;
  const float *image = series.pixels.data() + static_cast<std::ptrdiff_t>(frame) * geometry.columns * geometry.rows;
  std::vector<float> sorted(image, image + static_cast<std::ptrdiff_t>(geometry.columns) * geometry.rows);
  const auto top = sorted.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), top, sorted.end());
  const double scale = *top > 0 ? 235 / *top : 0;
  for (int y = 0; y < window.rows * enlargement; ++y)
    for (int x = 0; x < window.columns * enlargement; ++x)
    {
      const double column = std::clamp(window.column + (x + 0.5) / enlargement - 0.5, 0.0, geometry.columns - 1.001);
      const double row = std::clamp(window.row + (y + 0.5) / enlargement - 0.5, 0.0, geometry.rows - 1.001);
      const int c = static_cast<int>(column), r = static_cast<int>(row);
      const double fx = column - c, fy = row - r;
      const float *here = image + static_cast<std::ptrdiff_t>(r) * geometry.columns + c,
                  *below = here + geometry.columns;
      const double value = (1 - fy) * ((1 - fx) * here[0] + fx * here[1]) + fy * ((1 - fx) * below[0] + fx * below[1]);
      canvas.at(left + x, y).fill(std::clamp(scale * value, 0.0, 255.0));
    }
}

void draw_outline(Canvas &canvas, const dataset::ImageGeometry &geometry, const OverlayOutline &outline,
                  const Window &window, int left)
{
  const Pixels pixels = in_image(geometry, outline.points);
  const Colour colour = colour_of(outline);
  const auto on_canvas = [&](Eigen::Index i) -> Eigen::Vector2d
  {
    return {left + (pixels(i, 0) - window.column + 0.5) * enlargement - 0.5,
            (pixels(i, 1) - window.row + 0.5) * enlargement - 0.5};
  };
  double passed = 0;
  for (Eigen::Index i = 0, n = pixels.rows(); i < n; ++i)
  {
    const Eigen::Vector2d a = on_canvas(i), b = on_canvas((i + 1) % n);
    const int pieces = std::max(1, static_cast<int>(std::ceil(2 * (b - a).norm())));
    for (int k = 0; k < pieces; ++k)
    {
      const double at = passed + (b - a).norm() * k / pieces;
      if (!outline.is_dashed || std::fmod(at, 2 * dash) < dash)
        canvas.dot(a + (b - a) * k / pieces, colour);
    }
    passed += (b - a).norm();
  }
}

void write_png(const Canvas &canvas, const std::filesystem::path &file)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(canvas.width, canvas.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto *values = static_cast<unsigned char *>(image->GetScalarPointer());
  for (int y = canvas.height - 1; y >= 0; --y) // VTK's rows run upward
    for (int x = 0; x < canvas.width; ++x)
      for (const double value : canvas.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width) +
                                              static_cast<std::size_t>(x)])
        *values++ = static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0)));
  dataset::AtomicFile whole(file);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(whole.temporary_path().c_str());
  writer->SetInputData(image);
  writer->Write();
  if (writer->GetErrorCode() != 0 || !std::filesystem::exists(whole.temporary_path()))
    throw std::runtime_error("The picture " + file.string() + " cannot be written; is the disk full?");
  whole.publish();
}
} // namespace

void write_overlay(const dataset::ImageSeries &series, const std::vector<OverlayFrame> &frames,
                   const std::filesystem::path &file)
{
  for (const OverlayFrame &frame : frames)
    if (frame.frame < 0 || static_cast<std::size_t>(frame.frame) >= series.times_s.size())
      throw InputError("overlay: frame " + std::to_string(frame.frame) + " is wanted of a series of " +
                       std::to_string(series.times_s.size()) + " frames (0-based)");
  const Window window = window_of(series.geometry, frames);
  const int width = window.columns * enlargement;
  const int n = static_cast<int>(frames.size());
  Canvas canvas(n * width + (n - 1) * gap, window.rows * enlargement);
  int left = 0;
  for (const OverlayFrame &frame : frames)
  {
    draw_pixels(canvas, series, frame.frame, window, left);
    for (const OverlayOutline &outline : frame.outlines)
      draw_outline(canvas, series.geometry, outline, window, left);
    left += width + gap;
  }
  write_png(canvas, file);
}
} // namespace pelvireg::report
