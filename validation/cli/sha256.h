#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pelvireg::cli
{
/// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256_of_text(std::string_view text);
/// The same over a file's content. Throws InputError when the file cannot be read.
std::string sha256_of_file(const std::filesystem::path &file);
} // namespace pelvireg::cli
