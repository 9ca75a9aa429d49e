// DICOM series as images (GDCM stays behind this).
#pragma once

#include "synthetic/dataset/image_series.h"

#include <filesystem>

namespace pelvireg::observation
{
/// SOP class of what is read and written: MR Image Storage.
inline constexpr const char *mr_image_storage = "1.2.840.10008.5.1.4.1.1.4";

/// Folders that hold one MR series of single-frame grey images (MR Image Storage, any transfer syntax that GDCM
/// decodes), files in any order and of any name; hidden files and DICOMDIR are passed over, everything else must belong
/// to it. Rescale slope and intercept are applied where given.
///
/// A dynamic series: one plane in every file; the frame's time is the trigger time (0018,1060) or, where all files have
/// the same or none, the acquisition time (0008,0032), then the content time (0008,0033), both from the first frame on.
///
/// Throw InputError; the result has passed check() of image_checks.h.
dataset::ImageSeries read_dicom_series(const std::filesystem::path &folder);

/// A stack: parallel planes at even distances, sorted along their normal (row direction x column direction of DICOM).
dataset::ImageVolume read_dicom_volume(const std::filesystem::path &folder);
} // namespace pelvireg::observation
