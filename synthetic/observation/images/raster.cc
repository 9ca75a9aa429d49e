#include "synthetic/observation/images/raster.h"

#include <algorithm>
#include <cmath>

namespace pelvireg::observation
{
namespace
{
/// What a piece of edge inside one row adds: everything right of it in full, the pixels that it crosses in part.
/// `height` is the signed height of the piece as a share of the row; x0 and x1 count pixels from the raster's left
/// border. The differences are summed up along the row later.
void add_piece(double x0, double x1, double height, Eigen::Index row, Raster &difference)
{
  const double left = std::min(x0, x1), right = std::max(x0, x1);
  const Eigen::Index last = difference.cols() - 1; // one column more than the raster has: what lies right of it
  const auto column_of = [&](double x) { return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(x), 0, last); };
  double area_before = 0, share_before = 0; // right of the piece: up to this column, and in the column before
  for (Eigen::Index column = column_of(left); column <= last; ++column)
  {
    const double border = static_cast<double>(column + 1);
    const double area = right <= border ? border - 0.5 * (left + right)
                        : left < border ? 0.5 * (border - left) * (border - left) / (right - left)
                                        : 0;
    const double share = area - area_before;
    difference(row, column) += static_cast<float>(height * (share - share_before));
    if (right <= border)
    {
      if (column < last)
        difference(row, column + 1) += static_cast<float>(height * (1 - share));
      return;
    }
    area_before = area;
    share_before = share;
  }
}

/// An edge, piece by piece. Left of the raster it counts from its border on, right of it not at all.
void add_edge(Eigen::Vector2d from, Eigen::Vector2d to, Raster &difference)
{
  const double sign = to.y() > from.y() ? -1 : 1;
  if (to.y() < from.y())
    std::swap(from, to);
  const double rows = static_cast<double>(difference.rows()), columns = static_cast<double>(difference.cols() - 1);
  const double first = std::max(from.y(), 0.0), last = std::min(to.y(), rows);
  if (!(first < last))
    return;
  const double slope = (to.x() - from.x()) / (to.y() - from.y());
  const auto x_at = [&](double y) { return std::clamp(from.x() + slope * (y - from.y()), 0.0, columns); };
  const double left_at = from.y() - from.x() / slope, right_at = from.y() + (columns - from.x()) / slope;
  for (double y = first; y < last;)
  {
    // Pieces end where the edge meets a row's border or a side of the raster, beyond which it runs along that side.
    double next = std::min(std::floor(y) + 1, last);
    for (const double side : {left_at, right_at})
      if (side > y && side < next)
        next = side;
    add_piece(x_at(y), x_at(next), sign * (next - y), static_cast<Eigen::Index>(y), difference);
    y = next;
  }
}
} // namespace

void add_coverage(const PixelLoop &loop, Raster &coverage)
{
  Eigen::Index first = coverage.rows(), last = -1;
  for (const Eigen::Vector2d &point : loop)
  {
    first = std::min(first, static_cast<Eigen::Index>(std::clamp(point.y(), 0.0, coverage.rows() - 1.0)));
    last = std::max(last, static_cast<Eigen::Index>(std::clamp(point.y() + 1, 0.0, coverage.rows() - 1.0)));
  }
  if (loop.size() < 3)
    return;
  Raster difference = Raster::Zero(last - first + 1, coverage.cols() + 1);
  const Eigen::Vector2d shift(0.5, 0.5 - static_cast<double>(first)); // pixel centres to borders
  for (std::size_t i = 0; i < loop.size(); ++i)
    add_edge(loop[i] + shift, loop[(i + 1) % loop.size()] + shift, difference);
  for (Eigen::Index row = 0; row < difference.rows(); ++row)
  {
    double sum = 0;
    for (Eigen::Index column = 0; column < coverage.cols(); ++column)
    {
      sum += static_cast<double>(difference(row, column));
      coverage(first + row, column) += static_cast<float>(sum);
    }
  }
}

Eigen::Vector2d to_pixel(const dataset::ImageGeometry &geometry, const Eigen::Vector3d &point)
{
  const Eigen::Vector3d offset = point - geometry.origin;
  return {offset.dot(geometry.column_direction) / geometry.spacing[0],
          offset.dot(geometry.row_direction) / geometry.spacing[1]};
}

Eigen::Vector3d to_point(const dataset::ImageGeometry &geometry, double column, double row)
{
  return geometry.origin + column * geometry.spacing[0] * geometry.column_direction +
         row * geometry.spacing[1] * geometry.row_direction;
}

dataset::ImageGeometry refined(const dataset::ImageGeometry &geometry, int factor)
{
  dataset::ImageGeometry fine = geometry;
  const double first = 0.5 / factor - 0.5; // of the first pixel's centre, in coarse pixels
  fine.origin = to_point(geometry, first, first);
  fine.spacing = {geometry.spacing[0] / factor, geometry.spacing[1] / factor};
  fine.columns *= factor;
  fine.rows *= factor;
  return fine;
}
} // namespace pelvireg::observation
