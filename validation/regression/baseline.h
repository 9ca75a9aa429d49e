// Baselines: what a result is held against, and the only way to change it.
#pragma once

#include "validation/regression/compare.h"

#include <filesystem>
#include <map>
#include <string>

namespace pelvireg::regression
{
/// What made a result, beside what its manifest says.
struct Machine
{
  std::string packages;        ///< "libdeal.ii-dev 9.4.1-1, …"
  std::string instruction_set; ///< "avx512", …
};

/// Lay a result beside a baseline as a candidate: FOLDER/candidate/ with case.toml, errors_by_step.csv,
/// errors_by_slice.csv, runs.csv and baseline.json. The baseline stays as it is. A candidate that is there is replaced.
/// Throws InputError for a result that cannot be read or has fewer randomised runs than Rule::least_samples.
void propose_baseline(const std::filesystem::path &result, const std::filesystem::path &folder, const Machine &machine,
                      const Digest &digest);

/// Make the candidate the baseline. The reason and the SHA-256 of the baseline that it replaces are kept in
/// baseline.json. The anchor stays, unless there is none or `renew_anchor`. Throws InputError, and changes nothing,
/// when there is no candidate, it was changed, the baseline is another one than when it was proposed, the reason says
/// nothing, or the candidate is worse than the anchor or cannot be compared with it and the anchor is not renewed.
void accept_baseline(const std::filesystem::path &folder, const std::string &reason, bool renew_anchor,
                     const Digest &digest);
} // namespace pelvireg::regression
