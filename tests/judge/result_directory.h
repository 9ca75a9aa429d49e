// An evaluated result directory written by hand, and a folder to put it in.
#pragma once

#include "validation/regression/result.h"

#include <filesystem>
#include <string>

namespace pelvireg::test
{
/// Files with the content of `result`, as the stages write them: case.toml, the two CSV files, summary.json and
/// manifest.json with their digests.
void write_result(const regression::ErrorResult &result, const std::filesystem::path &directory);

/// Replace the first `pattern` in a file; the manifest knows of it only when `in_manifest`.
void edit(const std::filesystem::path &file, const std::string &pattern, const std::string &replacement,
          bool in_manifest = false);

} // namespace pelvireg::test
