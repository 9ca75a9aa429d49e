// Images as files: NRRD (the record) and DICOM series (what a scanner hands over).
#pragma once

#include "synthetic/dataset/image_series.h"

#include <filesystem>
#include <string>

namespace pelvireg::observation
{
/// A dynamic series of one plane: an NRRD file, or a folder that holds one DICOM MR series (files in any order; they
/// are sorted by time).
///
/// *NRRD.* One file (.nrrd, attached data), encoding raw or gzip, any scalar type, space LPS, RAS or LAS. Two spatial
/// axes of more than one pixel (a third may have size 1) and one axis without direction, at any place: time. Its frame
/// times, s, are the key/value pair `axis N index values`, N the 0-based index of that axis.
///
/// *DICOM.* See dicom_series.h.
///
/// Throws InputError, one sentence, for what is missing, corrupt, empty, of more than one series, not grey, without
/// geometry or times, of mixed geometry, with equal times or with a pixel that is not finite.
dataset::ImageSeries read_image_series(const std::filesystem::path &path);

/// A stack of parallel slices: an NRRD file of three spatial axes, or a folder with one DICOM MR series, sorted by
/// position. Throws InputError as read_image_series() does.
dataset::ImageVolume read_image_volume(const std::filesystem::path &path);

/// As read_image_series() and read_image_volume() read them, and 3D Slicer: float, raw, LPS. A series has four axes
/// (column, row, slice of size 1, time of kind `list`), because Slicer takes no sequence with fewer than three spatial
/// ones. Whole or not at all; no time stamps. Throws InputError for an image that image_checks.h refuses.
void write_nrrd(const dataset::ImageSeries &series, const std::filesystem::path &file);
void write_nrrd(const dataset::ImageVolume &volume, const std::filesystem::path &file);

/// One file an image, 0001.dcm …; explicit VR, little endian, 16 bit, one slope for the series: a pixel read back
/// differs by at most half a slope, which is the range of all pixels / 65535. `study` names patient and study; UIDs
/// come from the SHA-256 of study and content (2.25, UUID version 8), so the same images give the same bytes. What lay
/// in the folder is replaced as a whole. Throws InputError for an image that image_checks.h refuses.
void write_dicom(const dataset::ImageSeries &series, const std::string &study, const std::filesystem::path &folder);
void write_dicom(const dataset::ImageVolume &volume, const std::string &study, const std::filesystem::path &folder);
} // namespace pelvireg::observation
