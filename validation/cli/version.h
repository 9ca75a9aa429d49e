// Which program wrote a result. The values are made at build time by version.cmake.
#pragma once

#include <string>

namespace pelvireg::cli
{
/// "0.1.0"
std::string version();

/// Git revision, with "+changes" when the work tree differed; "unknown" outside a git repository.
std::string revision();

/// Compiler and build type: "GNU 12.2.0, Release".
std::string build();

/// SHA-256 over the sources of one folder ("reference_fe", "synthetic/anatomy", …): a stage is run again when the code
/// behind it has changed, and only then. Throws std::out_of_range for a folder that is not listed in version.cmake.
std::string source_digest(const std::string &folder);
} // namespace pelvireg::cli
