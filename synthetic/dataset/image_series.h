// MR images: one plane over time, and stacks of parallel slices. Types only; reading and writing are in
// synthetic/observation/images/image_files.h.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// Where the pixels of one image lie. The centre of the pixel (column c, row r), both 0-based, is
/// origin + c spacing[0] column_direction + r spacing[1] row_direction.
struct ImageGeometry
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();            ///< centre of the first pixel, mm, LPS
  Eigen::Vector3d column_direction = Eigen::Vector3d::UnitY(); ///< unit, from a pixel to the next in its row
  Eigen::Vector3d row_direction = -Eigen::Vector3d::UnitZ();   ///< unit, from a row to the next
  std::array<double, 2> spacing = {1, 1};                      ///< mm, column step and row step
  int columns = 0, rows = 0;
};

/// One plane over time.
struct ImageSeries
{
  ImageGeometry geometry;
  double slice_thickness_mm = 0;
  std::vector<double> times_s; ///< one a frame, strictly increasing
  std::vector<float> pixels;   ///< frame-major, then row-major: pixel (f, r, c) is (f rows + r) columns + c
  std::string description;     ///< one line
};

/// Parallel slices at one instant.
struct ImageVolume
{
  ImageGeometry geometry;                                 ///< of the first slice
  Eigen::Vector3d slice_step = Eigen::Vector3d::UnitX();  ///< from a slice to the next, mm; normal to the slices
  int slices = 0;
  double slice_thickness_mm = 0; ///< may be less than the step: a gap
  std::vector<float> pixels;     ///< slice-major, then row-major
  std::string description;       ///< one line
};
} // namespace pelvireg::dataset
