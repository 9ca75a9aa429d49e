// A page of HTML as PDF, by Chromium without a window.
#pragma once

#include <filesystem>
#include <string>

namespace pelvireg::report
{
/// Print `html` to `file` (a temporary name, renamed). The dates that Chromium writes are set to the epoch: the same
/// page gives the same bytes with the same Chromium. Throws InputError when there is no Chromium in PATH,
/// std::runtime_error when it fails or takes longer than `time_limit_s`.
void print_pdf(const std::string &html, const std::filesystem::path &file, double time_limit_s = 120);
} // namespace pelvireg::report
