// Pictures for the page: a third of the bytes of the files beside it.
#pragma once

#include <filesystem>
#include <string>

namespace pelvireg::report
{
/// The picture of a PNG file as a JPEG file's bytes, quality 90. Empty when it cannot be read or is no PNG file.
std::string jpeg_of_png(const std::filesystem::path &file);
} // namespace pelvireg::report
