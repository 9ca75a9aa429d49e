// NRRD: what is written is read; what Slicer writes is read; what is wrong is refused with one sentence.
#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/image_files.h"
#include "tests/unit/observation/images/sample_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

namespace pelvireg::observation::test
{
namespace
{
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string head = "NRRD0004\ntype: short\ndimension: 4\nspace: left-posterior-superior\nendian: little\n"
                         "space origin: (1,2,3)\nkinds: domain domain domain list\nsizes: 2 3 1 2\n"
                         "space directions: (0,1.5,0) (0,0,-2) (6,0,0) none\naxis 3 index values:=0 0.5\n";
const std::string twelve = std::string("\1\0\2\0\3\0\4\0\5\0\6\0\7\0\10\0\11\0\12\0\13\0\14\0", 24);

std::string replaced(std::string text, const std::string &what, const std::string &with)
{
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

class Nrrd : public ::testing::Test
{
protected:
  std::filesystem::path file(const std::string &content) const
  {
    const std::filesystem::path path = folder_ / "image.nrrd";
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  std::string refusal(const std::string &content) const
  {
    return refusal_of([&] { read_image_series(file(content)); });
  }

  Scratch folder_;
};
} // namespace

TEST_F(Nrrd, SeriesIsReadAsItWasWritten)
{
  const dataset::ImageSeries series = sample_series();
  write_nrrd(series, folder_ / "dyn.nrrd");
  const dataset::ImageSeries read = read_image_series(folder_ / "dyn.nrrd");
  expect_same_geometry(read.geometry, series.geometry, 1e-14);
  EXPECT_EQ(read.times_s, series.times_s);
  EXPECT_EQ(read.pixels, series.pixels);
  EXPECT_EQ(read.slice_thickness_mm, series.slice_thickness_mm);
  EXPECT_EQ(read.description, series.description);
}

TEST_F(Nrrd, VolumeIsReadAsItWasWritten)
{
  const dataset::ImageVolume volume = sample_volume();
  write_nrrd(volume, folder_ / "tse.nrrd");
  const dataset::ImageVolume read = read_image_volume(folder_ / "tse.nrrd");
  expect_same_geometry(read.geometry, volume.geometry, 1e-14);
  EXPECT_LT((read.slice_step - volume.slice_step).norm(), 1e-14);
  EXPECT_EQ(read.slices, volume.slices);
  EXPECT_EQ(read.slice_thickness_mm, volume.slice_thickness_mm);
  EXPECT_EQ(read.pixels, volume.pixels);
}

TEST_F(Nrrd, OfOtherTypeOrderAndSpaceIsRead)
{
  const dataset::ImageSeries plain = read_image_series(file(head + "encoding: raw\n\n" + twelve));
  EXPECT_EQ(plain.geometry.columns, 2);
  EXPECT_EQ(plain.geometry.rows, 3);
  EXPECT_THAT(plain.geometry.spacing, ElementsAre(1.5, 2.0));
  EXPECT_EQ(plain.slice_thickness_mm, 6);
  EXPECT_THAT(plain.times_s, ElementsAre(0, 0.5));
  EXPECT_EQ(plain.pixels[1], 2);

  // Right-anterior-superior: x and y change their signs.
  const dataset::ImageSeries ras =
      read_image_series(file(replaced(head, "left-posterior", "right-anterior") + "encoding: raw\n\n" + twelve));
  EXPECT_LT((ras.geometry.origin - Eigen::Vector3d(-1, -2, 3)).norm(), 1e-15);
  EXPECT_LT((ras.geometry.column_direction + Eigen::Vector3d::UnitY()).norm(), 1e-15);

  std::string swapped = twelve;
  for (std::size_t i = 0; i < swapped.size(); i += 2)
    std::swap(swapped[i], swapped[i + 1]);
  EXPECT_EQ(read_image_series(file(replaced(head, "little", "big") + "encoding: raw\n\n" + swapped)).pixels,
            plain.pixels);
}

TEST_F(Nrrd, WithTimeAsTheFirstAxisIsRead)
{
  std::string first = replaced(head, "sizes: 2 3 1 2", "sizes: 2 2 3 1");
  first = replaced(first, "(0,1.5,0) (0,0,-2) (6,0,0) none", "none (0,1.5,0) (0,0,-2) (6,0,0)");
  first = replaced(first, "domain domain domain list", "list domain domain domain");
  first = replaced(first, "axis 3", "axis 0");
  const dataset::ImageSeries series = read_image_series(file(first + "encoding: raw\n\n" + twelve));
  EXPECT_THAT(series.pixels, ElementsAre(1, 3, 5, 7, 9, 11, 2, 4, 6, 8, 10, 12));
}

TEST_F(Nrrd, WithGzipIsRead)
{
  const std::filesystem::path packed_file = folder_ / "pixels.gz";
  const gzFile out = gzopen(packed_file.c_str(), "wb");
  gzwrite(out, twelve.data(), static_cast<unsigned>(twelve.size()));
  gzclose(out);
  const std::string packed = bytes_of(packed_file);
  EXPECT_EQ(read_image_series(file(head + "encoding: gzip\n\n" + packed)).pixels[11], 12);
  EXPECT_THAT(refusal(head + "encoding: gzip\n\n" + packed.substr(0, packed.size() / 2)), HasSubstr("gzip"));
}

TEST_F(Nrrd, ThatIsWrongIsRefused)
{
  const std::string raw = "encoding: raw\n\n";
  EXPECT_THAT(refusal(""), HasSubstr("is not an NRRD file"));
  EXPECT_THAT(refusal("PNG"), HasSubstr("is not an NRRD file"));
  EXPECT_THAT(refusal(head), HasSubstr("ends within its NRRD header"));
  EXPECT_THAT(refusal(head + raw + twelve.substr(1)), HasSubstr("holds 23 bytes of pixels, but its sizes need 24"));
  EXPECT_THAT(refusal(head + raw + twelve + "x"), HasSubstr("too many"));
  EXPECT_THAT(refusal(replaced(head, "sizes: 2 3 1 2", "sizes: 2 3 1 0") + raw + twelve),
              HasSubstr("has the size '0'"));
  EXPECT_THAT(refusal(replaced(head, "sizes: 2 3 1 2", "sizes: 1000000 1000000 1 1000000") + raw), HasSubstr("4 GiB"));
  EXPECT_THAT(refusal(replaced(head, "axis 3 index values:=0 0.5", "k:=v") + raw + twelve),
              HasSubstr("does not say when its frames were taken"));
  EXPECT_THAT(refusal(replaced(head, "0 0.5", "0 0") + raw + twelve), HasSubstr("must be finite and increase"));
  EXPECT_THAT(refusal(replaced(head, "0 0.5", "0") + raw + twelve), HasSubstr("2 frames but 1 frame times"));
  EXPECT_THAT(refusal(replaced(head, "0 0.5", "0 soon") + raw + twelve), HasSubstr("'soon'"));
  EXPECT_THAT(refusal(replaced(head, " list", " RGB-color") + raw + twelve), HasSubstr("grey images are needed"));
  EXPECT_THAT(refusal(replaced(head, "(0,0,-2)", "(0,1,-2)") + raw + twelve), HasSubstr("not perpendicular"));
  EXPECT_THAT(refusal(replaced(head, "(0,0,-2)", "(0,0,0)") + raw + twelve), HasSubstr("pixel spacing of 0 mm"));
  EXPECT_THAT(refusal(replaced(head, "left-posterior-superior", "scanner-xyz") + raw + twelve),
              HasSubstr("scanner-xyz"));
  EXPECT_THAT(refusal(replaced(head, "type: short", "type: block") + raw + twelve), HasSubstr("'block'"));
  EXPECT_THAT(refusal(head + "data file: other.raw\n" + raw + twelve), HasSubstr("as one .nrrd file"));
  EXPECT_THAT(refusal_of([&] { read_image_series(folder_ / "none.nrrd"); }), HasSubstr("does not exist"));
  EXPECT_THAT(refusal_of([&] { read_image_volume(file(head + raw + twelve)); }), HasSubstr("needed"));
}

TEST_F(Nrrd, WithAPixelThatIsNoNumberIsRefused)
{
  const std::string floats = replaced(head, "type: short", "type: float");
  std::vector<float> pixels(12, 1.0f);
  pixels[9] = std::numeric_limits<float>::quiet_NaN();
  std::string bytes(48, '\0');
  std::memcpy(bytes.data(), pixels.data(), 48);
  EXPECT_THAT(refusal(floats + "encoding: raw\n\n" + bytes), HasSubstr("frame 1, row 1, column 1"));
  dataset::ImageSeries series = sample_series();
  series.pixels[5] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal_of([&] { write_nrrd(series, folder_ / "bad.nrrd"); }), HasSubstr("not a finite number"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.nrrd"));
}
} // namespace pelvireg::observation::test
