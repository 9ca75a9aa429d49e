// DICOM: series are read as they were written, in any order of files; what is wrong is refused with one sentence.
#include "synthetic/observation/images/content_uid.h"
#include "synthetic/observation/images/image_files.h"
#include "tests/unit/observation/images/sample_images.h"

#include <gdcmReader.h>
#include <gdcmWriter.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace pelvireg::observation::test
{
namespace
{
using ::testing::HasSubstr;

/// Writes a file again with one text field changed.
void change(const std::filesystem::path &file, std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr,
            std::string text)
{
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  ASSERT_TRUE(reader.Read());
  if (text.size() % 2)
    text += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement field(gdcm::Tag(group, element));
  field.SetVR(vr);
  field.SetByteValue(text.data(), static_cast<std::uint32_t>(text.size()));
  reader.GetFile().GetDataSet().Replace(field);
  gdcm::Writer writer;
  writer.SetFile(reader.GetFile());
  writer.SetFileName(file.c_str());
  ASSERT_TRUE(writer.Write());
}

class Dicom : public ::testing::Test
{
protected:
  Dicom() { write_dicom(series_, "case", dyn_); }
  std::string refusal() const
  {
    return refusal_of([&] { read_image_series(dyn_); });
  }

  Scratch folder_;
  std::filesystem::path dyn_ = folder_ / "dyn";
  dataset::ImageSeries series_ = sample_series();
};
} // namespace

TEST_F(Dicom, SeriesIsReadAsItWasWrittenToHalfAStepOfItsStoredValues)
{
  const dataset::ImageSeries read = read_image_series(dyn_);
  expect_same_geometry(read.geometry, series_.geometry, 1e-12); // 16 characters a number
  ASSERT_EQ(read.times_s.size(), series_.times_s.size());
  for (std::size_t i = 0; i < read.times_s.size(); ++i)
    EXPECT_NEAR(read.times_s[i], series_.times_s[i], 1e-9);
  EXPECT_EQ(read.slice_thickness_mm, 8);
  EXPECT_EQ(read.description, "four frames");
  const float half_step = 0.5f * *std::max_element(series_.pixels.begin(), series_.pixels.end()) / 65535;
  ASSERT_EQ(read.pixels.size(), series_.pixels.size());
  for (std::size_t i = 0; i < read.pixels.size(); ++i)
    EXPECT_NEAR(read.pixels[i], series_.pixels[i], 1.01f * half_step);
}

TEST_F(Dicom, VolumeIsReadAsItWasWrittenUpToItsDirection)
{
  const dataset::ImageVolume volume = sample_volume(); // its step runs against the normal: read the other way round
  write_dicom(volume, "case", folder_ / "tse");
  const dataset::ImageVolume read = read_image_volume(folder_ / "tse");
  EXPECT_EQ(read.slices, 3);
  EXPECT_LT((read.slice_step + volume.slice_step).norm(), 1e-9);
  EXPECT_LT((read.geometry.origin - (volume.geometry.origin + 2 * volume.slice_step)).norm(), 1e-9);
  EXPECT_NEAR(read.pixels[0], volume.pixels[70], 1e-5);
  EXPECT_EQ(read.slice_thickness_mm, 5);
}

TEST_F(Dicom, FilesOfAnyOrderAndNameAreSortedByTime)
{
  const dataset::ImageSeries sorted = read_image_series(dyn_);
  std::filesystem::rename(dyn_ / "0001.dcm", dyn_ / "zz");
  std::filesystem::rename(dyn_ / "0004.dcm", dyn_ / "a.ima");
  std::ofstream(dyn_ / ".hidden") << "x";
  std::ofstream(dyn_ / "DICOMDIR") << "x";
  const dataset::ImageSeries read = read_image_series(dyn_);
  EXPECT_EQ(read.times_s, sorted.times_s);
  EXPECT_EQ(read.pixels, sorted.pixels);
}

TEST_F(Dicom, OfTheSameImagesHasTheSameBytesAndOfOthersOtherIdentifiers)
{
  write_dicom(series_, "case", folder_ / "again");
  EXPECT_EQ(bytes_of(dyn_ / "0003.dcm"), bytes_of(folder_ / "again" / "0003.dcm"));
  gdcm::Reader first, other;
  first.SetFileName((dyn_ / "0003.dcm").c_str());
  series_.pixels[0] += 0.1f;
  write_dicom(series_, "case", folder_ / "other");
  other.SetFileName((folder_ / "other" / "0003.dcm").c_str());
  ASSERT_TRUE(first.Read() && other.Read());
  const auto uid = [](const gdcm::Reader &reader, std::uint16_t element)
  {
    const gdcm::ByteValue *value =
        reader.GetFile().GetDataSet().GetDataElement(gdcm::Tag(0x0020, element)).GetByteValue();
    return std::string(value->GetPointer(), value->GetLength());
  };
  EXPECT_EQ(uid(first, 0x000D), uid(other, 0x000D)); // one study
  EXPECT_NE(uid(first, 0x000E), uid(other, 0x000E)); // two series
}

TEST_F(Dicom, TimesFallBackToTheAcquisition)
{
  for (const char *name : {"0001.dcm", "0002.dcm", "0003.dcm", "0004.dcm"})
    change(dyn_ / name, 0x0018, 0x1060, gdcm::VR::DS, "0"); // as scanners write it without a trigger
  const dataset::ImageSeries read = read_image_series(dyn_);
  for (std::size_t i = 0; i < read.times_s.size(); ++i)
    EXPECT_NEAR(read.times_s[i], series_.times_s[i], 1e-6);
  for (const char *name : {"0001.dcm", "0002.dcm", "0003.dcm", "0004.dcm"})
    change(dyn_ / name, 0x0008, 0x0032, gdcm::VR::TM, "");
  EXPECT_THAT(refusal(), HasSubstr("does not say when its frames were taken"));
}

TEST_F(Dicom, ThatIsWrongIsRefused)
{
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_THAT(refusal_of([&] { read_image_series(folder_ / "empty"); }), HasSubstr("holds no file"));
  EXPECT_THAT(refusal_of([&] { read_image_series(folder_ / "none"); }), HasSubstr("does not exist"));
  const auto with = [&](auto &&damage)
  {
    write_dicom(series_, "case", dyn_);
    damage(dyn_ / "0002.dcm");
    return refusal();
  };
  using Path = std::filesystem::path;
  using gdcm::VR;
  EXPECT_THAT(with([](const Path &file) { std::ofstream(file) << "not an image"; }), HasSubstr("cannot be read"));
  EXPECT_THAT(with([](const Path &file) { std::ofstream{file}; }), HasSubstr("cannot be read"));
  EXPECT_THAT(with([](const Path &file) { std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9); }),
              HasSubstr("ends too soon"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0018, 0x1060, VR::DS, "600"); }),
              HasSubstr("were taken at the same time"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0020, 0x000E, VR::UI, "1.2.3"); }),
              HasSubstr("of another series"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0020, 0x0032, VR::DS, "1\\2\\3"); }),
              HasSubstr("lies elsewhere"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0020, 0x0032, VR::DS, "1\\2"); }),
              HasSubstr("image position"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0020, 0x0037, VR::DS, "0\\1\\0\\0\\0\\-1"); }),
              HasSubstr("orientation"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0028, 0x0030, VR::DS, "1.5\\1.5"); }),
              HasSubstr("pixel spacing"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0008, 0x0016, VR::UI, "1.2.840.10008.5.1.4.1.1.2"); }),
              HasSubstr("MR Image Storage"));
  EXPECT_THAT(with([](const Path &file) { change(file, 0x0028, 0x0004, VR::CS, "MONOCHROME1"); }), HasSubstr("grey"));
}

TEST_F(Dicom, InColourIsRefused)
{
  using gdcm::VR;
  const std::filesystem::path file = dyn_ / "0002.dcm";
  const std::string byte("\x08\x00", 2), high_bit("\x07\x00", 2), three("\x03\x00", 2), interleaved(2, '\0');
  change(file, 0x0028, 0x0002, VR::US, three);
  change(file, 0x0028, 0x0004, VR::CS, "RGB");
  change(file, 0x0028, 0x0006, VR::US, interleaved);
  change(file, 0x0028, 0x0100, VR::US, byte);
  change(file, 0x0028, 0x0101, VR::US, byte);
  change(file, 0x0028, 0x0102, VR::US, high_bit);
  const auto n_pixels = static_cast<std::size_t>(series_.geometry.rows * series_.geometry.columns);
  change(file, 0x7FE0, 0x0010, VR::OB, std::string(3 * n_pixels, 'x'));
  EXPECT_THAT(refusal(), HasSubstr("RGB with 3 value(s) a pixel, but grey images"));
}

TEST_F(Dicom, OfAnotherSizeIsRefused)
{
  dataset::ImageSeries small = series_;
  small.geometry.rows = 4;
  small.pixels.resize(4 * 28);
  write_dicom(small, "case", folder_ / "small");
  const std::filesystem::path stranger = dyn_ / "0009.dcm";
  std::filesystem::copy_file(folder_ / "small" / "0002.dcm", stranger);
  EXPECT_THAT(refusal(), HasSubstr("of another series"));
  gdcm::Reader reader; // into the same series
  reader.SetFileName((dyn_ / "0001.dcm").c_str());
  ASSERT_TRUE(reader.Read());
  const gdcm::ByteValue *uid = reader.GetFile().GetDataSet().GetDataElement(gdcm::Tag(0x0020, 0x000E)).GetByteValue();
  change(stranger, 0x0020, 0x000E, gdcm::VR::UI, std::string(uid->GetPointer(), uid->GetLength()));
  EXPECT_THAT(refusal(), HasSubstr("all must have the same"));
}

TEST_F(Dicom, StackWithAMissingSliceIsRefused)
{
  dataset::ImageVolume volume = sample_volume();
  volume.slices = 4;
  volume.pixels = sample_pixels(4 * 35);
  write_dicom(volume, "case", folder_ / "ffe");
  std::filesystem::remove(folder_ / "ffe" / "0002.dcm");
  EXPECT_THAT(refusal_of([&] { read_image_volume(folder_ / "ffe"); }), HasSubstr("even distance"));
}

TEST(ContentUid, IsAUuidAndDependsOnEveryCharacter)
{
  EXPECT_EQ(content_uid("a"), content_uid("a"));
  EXPECT_NE(content_uid("a"), content_uid("b"));
  const std::string uid = content_uid("a");
  EXPECT_EQ(uid.rfind("2.25.", 0), 0u);
  EXPECT_LE(uid.size(), 44u);
  // First 16 bytes of SHA-256("a") = ca978112ca1bbdcafac231b39a23dc4d with version 8 and variant set:
  // ca978112-ca1b-8dca-bac2-31b39a23dc4d.
  EXPECT_EQ(uid, "2.25.269290709893686844195134956664967650381");
}
} // namespace pelvireg::observation::test
