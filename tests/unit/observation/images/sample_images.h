// Small images with every pixel of its own, and what the tests of files share.
#pragma once

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/image_series.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <unistd.h>

namespace pelvireg::observation::test
{
/// An empty folder, removed at the end.
class Scratch
{
public:
  Scratch()
  {
    std::string name = (std::filesystem::temp_directory_path() / "pelvireg-images-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch &) = delete;
  Scratch &operator=(const Scratch &) = delete;
  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path &file)
{
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

/// The message of the InputError that `action` throws.
inline std::string refusal_of(const std::function<void()> &action)
{
  try
  {
    action();
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "not refused";
}

/// A tilted plane of 7 x 5 pixels.
inline dataset::ImageGeometry sample_geometry()
{
  dataset::ImageGeometry geometry;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  geometry.origin = {12.345678, -101.5, 77.25};
  geometry.column_direction = turn.col(1);
  geometry.row_direction = -turn.col(2);
  geometry.spacing = {1.5, 1.25};
  geometry.columns = 7;
  geometry.rows = 5;
  return geometry;
}

inline std::vector<float> sample_pixels(std::size_t n)
{
  std::vector<float> pixels(n);
  for (std::size_t i = 0; i < n; ++i)
    pixels[i] = static_cast<float>(std::abs(std::sin(0.7 * static_cast<double>(i))));
  return pixels;
}

inline dataset::ImageSeries sample_series()
{
  return {sample_geometry(), 8, {0, 0.25, 0.6, 75.5}, sample_pixels(4 * 35), "four frames"};
}

inline dataset::ImageVolume sample_volume()
{
  const dataset::ImageGeometry geometry = sample_geometry();
  return {geometry, -6 * geometry.column_direction.cross(geometry.row_direction), 3, 5, sample_pixels(3 * 35), "stack"};
}

inline void expect_same_geometry(const dataset::ImageGeometry &a, const dataset::ImageGeometry &b, double tolerance)
{
  EXPECT_LE((a.origin - b.origin).norm(), tolerance * 100);
  EXPECT_LE((a.column_direction - b.column_direction).norm(), tolerance);
  EXPECT_LE((a.row_direction - b.row_direction).norm(), tolerance);
  EXPECT_NEAR(a.spacing[0], b.spacing[0], tolerance);
  EXPECT_NEAR(a.spacing[1], b.spacing[1], tolerance);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.rows, b.rows);
}
} // namespace pelvireg::observation::test
