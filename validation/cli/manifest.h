// manifest.json: what is in a result directory, what made it, and from what.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace pelvireg::cli
{
/// File name inside the result directory to SHA-256 of its content.
using FileDigests = std::map<std::string, std::string>;

/// One finished stage.
struct StageRecord
{
  std::string key; ///< SHA-256 over code, options and inputs: equal keys give equal outputs
  FileDigests inputs;
  FileDigests outputs;
  double seconds = 0;
  std::string command_line;
  std::string revision;                ///< of the program that ran it
  std::map<std::string, double> notes; ///< figures that a stage hands on beside its files (step times, ms)
};

struct Manifest
{
  std::map<std::string, StageRecord> stages;

  /// The stage that made a file, or null.
  const StageRecord *maker_of(const std::string &file, std::string *stage_name = nullptr) const;
  /// A file is about to have a new maker (truth.h5: reference or import): the stage that made it counts as not run.
  void forget(const std::string &file);
};

/// An empty manifest when the directory has none. Throws InputError for a manifest that cannot be read.
Manifest load_manifest(const std::filesystem::path &directory);
/// Throws std::runtime_error when the disk refuses.
void save_manifest(const Manifest &manifest, const std::filesystem::path &directory);
} // namespace pelvireg::cli
