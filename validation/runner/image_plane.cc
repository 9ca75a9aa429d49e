#include "validation/runner/image_plane.h"

#include <Eigen/Geometry>

namespace pelvireg::runner
{
tracking::PixelPoints to_pixels(const dataset::ImageGeometry &geometry, const dataset::Points &points)
{
  const dataset::Points from_origin = points.rowwise() - geometry.origin.transpose();
  tracking::PixelPoints pixels(points.rows(), 2);
  pixels.col(0) = from_origin * geometry.column_direction / geometry.spacing[0];
  pixels.col(1) = from_origin * geometry.row_direction / geometry.spacing[1];
  return pixels;
}

dataset::Points to_space(const dataset::ImageGeometry &geometry, const tracking::PixelPoints &pixels)
{
  return ((geometry.spacing[0] * pixels.col(0)) * geometry.column_direction.transpose() +
          (geometry.spacing[1] * pixels.col(1)) * geometry.row_direction.transpose())
             .rowwise() +
         geometry.origin.transpose();
}

double distance_from_plane(const dataset::ImageGeometry &geometry, const dataset::Points &points)
{
  const Eigen::Vector3d normal = geometry.column_direction.cross(geometry.row_direction);
  return ((points.rowwise() - geometry.origin.transpose()) * normal).cwiseAbs().maxCoeff();
}

tracking::Image frame_of(const dataset::ImageSeries &series, std::size_t number)
{
  const int columns = series.geometry.columns, rows = series.geometry.rows;
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(columns) * rows;
  const auto first = series.pixels.begin() + static_cast<std::ptrdiff_t>(number) * size;
  return {columns, rows, {first, first + size}};
}
} // namespace pelvireg::runner
