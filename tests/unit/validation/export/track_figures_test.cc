#include "validation/report/track_figures.h"

#include "synthetic/dataset/error.h"
#include "tests/scratch_folder.h"
#include "validation/report/jpeg.h"

#include <gtest/gtest.h>

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>
#include <fstream>

namespace pelvireg::report
{
namespace
{
/// Two grey frames of 60 x 60 pixels of 1 mm, the second brighter on its right half.
dataset::ImageSeries series()
{
  dataset::ImageSeries images;
  images.geometry.columns = images.geometry.rows = 60;
  images.times_s = {0, 0.4};
  images.pixels.assign(2 * 60 * 60, 0.5F);
  for (int row = 0; row < 60; ++row)
    for (int column = 30; column < 60; ++column)
      images.pixels[static_cast<std::size_t>(3600 + 60 * row + column)] = 1;
  return images;
}

/// A square from column and row 20 to 40.
dataset::Points square()
{
  dataset::Points points(4, 3);
  points << 0, 20, -20, 0, 40, -20, 0, 40, -40, 0, 20, -40;
  return points;
}

struct Picture
{
  vtkNew<vtkPNGReader> reader;

  explicit Picture(const std::filesystem::path &file)
  {
    reader->SetFileName(file.c_str());
    reader->Update();
  }
  int width() const { return reader->GetOutput()->GetDimensions()[0]; }
  int height() const { return reader->GetOutput()->GetDimensions()[1]; }
  /// Rows from the top.
  std::array<int, 3> at(int x, int y) const
  {
    const auto *pixel = static_cast<unsigned char *>(reader->GetOutput()->GetScalarPointer(x, height() - 1 - y, 0));
    return {pixel[0], pixel[1], pixel[2]};
  }
};
} // namespace

TEST(JpegOfPng, IsTheSamePictureAndNothingOfAnotherFile)
{
  const test::ScratchFolder folder;
  const std::filesystem::path png = folder / "overlay.png", jpeg = folder / "overlay.jpg";
  write_overlay(series(), {{0, {}}, {1, {}}}, png);
  const std::string bytes = jpeg_of_png(png);
  std::ofstream(jpeg, std::ios::binary) << bytes;
  EXPECT_EQ(jpeg_of_png(png), bytes);
  vtkNew<vtkJPEGReader> reader;
  reader->SetFileName(jpeg.c_str());
  reader->Update();
  const Picture picture(png);
  ASSERT_EQ(reader->GetOutput()->GetDimensions()[0], picture.width());
  ASSERT_EQ(reader->GetOutput()->GetDimensions()[1], picture.height());
  for (const int x : {picture.width() / 8, 7 * picture.width() / 8})
  {
    const int y = picture.height() / 2;
    const auto *pixel =
        static_cast<unsigned char *>(reader->GetOutput()->GetScalarPointer(x, picture.height() - 1 - y, 0));
    EXPECT_NEAR(pixel[0], picture.at(x, y)[0], 3) << x;
  }
  EXPECT_EQ(jpeg_of_png(jpeg), "");
  EXPECT_EQ(jpeg_of_png(folder / "none.png"), "");
}

TEST(TrackFigure, DrawsOutlinesOverTheFramesInTheirPlace)
{
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "track.png";
  write_overlay(series(), {{0, {{"bladder", square(), false}}}, {1, {{"bladder", square(), true}}}}, file);
  const Picture picture(file);
  // Columns 5 … 55 and three picture pixels each, twice, with a gap of six.
  ASSERT_EQ(picture.width(), 2 * 3 * 51 + 6);
  ASSERT_EQ(picture.height(), 3 * 51);
  const auto on_outline = picture.at((20 - 5) * 3 + 1, (30 - 5) * 3 + 1), inside = picture.at(75, 75);
  EXPECT_GT(on_outline[0], 200); // the bladder is red
  EXPECT_LT(on_outline[1], 120);
  EXPECT_EQ(inside[0], inside[1]);
  EXPECT_EQ(inside[1], inside[2]);
  const int second = 3 * 51 + 6;
  EXPECT_LT(picture.at(second + 40, 10)[0], picture.at(second + 140, 10)[0]);
  int n_white = 0;
  for (int y = (20 - 5) * 3 + 1; y < (40 - 5) * 3; ++y)
    n_white += picture.at(second + (20 - 5) * 3 + 1, y)[0] > 250;
  EXPECT_GT(n_white, 15); // dashed: about half of 60
  EXPECT_LT(n_white, 45);
}

TEST(TrackFigure, RefusesAFrameThatIsNotThere)
{
  EXPECT_THROW(write_overlay(series(), {{2, {{"bladder", square(), false}}}}, "never.png"), InputError);
  EXPECT_FALSE(std::filesystem::exists("never.png"));
}
} // namespace pelvireg::report
