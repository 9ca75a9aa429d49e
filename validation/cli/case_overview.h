// Several cases side by side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// The mean surface error at the last step (full, nominal or mean over the runs; mm) and the verdict on each claim, one
/// line a result directory. Figures and verdicts are those of summary.json. Throws InputError for one that is missing
/// or cannot be read.
std::string case_overview(const std::vector<std::filesystem::path> &directories);
} // namespace pelvireg::cli
