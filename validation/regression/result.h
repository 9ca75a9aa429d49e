// The two sides of a comparison: a result directory, or a baseline kept in a repository.
#pragma once

#include "validation/regression/curves.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pelvireg::regression
{
inline constexpr const char *baseline_format_version = "1.0";

/// SHA-256 of a text as 64 lower-case hexadecimal digits.
using Digest = std::function<std::string(std::string_view)>;

/// Steps of one run.
struct RunSteps
{
  int n_steps = 0, n_failed = 0;
  bool operator==(const RunSteps &) const = default;
};

/// Everything that is compared of one evaluated result.
struct ErrorResult
{
  std::string label; ///< where it came from, as the user said it
  std::string case_name;
  std::string case_text;                                ///< case.toml
  double surface_spacing = 0, contour_spacing = 0;      ///< mm, of the judge's points
  Curves curves;                                        ///< by step and by slice
  std::map<std::pair<std::string, int>, RunSteps> runs; ///< by condition and sample, without `unregistered`
  std::string revision, build;                          ///< of the program
  std::map<std::string, std::string> commands;          ///< stage to command line
  std::map<std::string, std::string> inputs;            ///< name to SHA-256 of the HDF5 files behind the curves
};

/// What a current result is held against.
struct Baseline
{
  ErrorResult rolling;               ///< what was accepted last
  std::optional<ErrorResult> anchor; ///< frozen, so that accepted losses do not add up; a result directory has none
};

/// Read an evaluated result directory: manifest.json, summary.json, case.toml and the two CSV files. Throws InputError
/// with one sentence when a file is missing, is not what its stage wrote (SHA-256), was made from other files than
/// those there now, has another format, version, unit or frame, or holds what read_curves refuses.
ErrorResult load_result(const std::filesystem::path &directory, const Digest &digest);

/// Read a baseline folder (baseline.json and the files it lists; anchor/ likewise), or a result directory in its place.
/// Throws InputError: as load_result; "MISSING" when there is neither; when a file was changed by another way than
/// `pelvireg baseline`.
Baseline load_baseline(const std::filesystem::path &folder, const Digest &digest);

/// True when the folder holds a baseline.json.
bool is_baseline(const std::filesystem::path &folder);
/// One baseline without its anchor.
ErrorResult load_baseline_part(const std::filesystem::path &folder, const Digest &digest);

/// "condition,sample,n_steps,n_failed_steps", one row a run.
std::string runs_csv(const ErrorResult &result);

/// Whole content of a file. Throws InputError when it cannot be read; `remedy` ends the sentence.
std::string read_text(const std::filesystem::path &file, const std::string &remedy);
} // namespace pelvireg::regression
