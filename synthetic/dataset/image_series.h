// A dynamic image series in one plane.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <string>
#include <vector>

namespace pelvireg::dataset
{
struct ImageGeometry
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< mm, LPS, centre of the first pixel
  Eigen::Vector3d column_direction = Eigen::Vector3d::UnitY();
  Eigen::Vector3d row_direction = -Eigen::Vector3d::UnitZ();
  double spacing[2] = {1.5, 1.5}; ///< mm, from column to column and from row to row
  int columns = 0, rows = 0;
};

struct ImageSeries
{
  ImageGeometry geometry;
  double slice_thickness_mm = 0;
  std::vector<double> times_s;
  std::vector<float> pixels; ///< frame by frame, row by row
  std::string description;
};
} // namespace pelvireg::dataset
