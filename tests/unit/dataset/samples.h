// Small contents of every file, with every field set to a value of its own.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/observations.h"
#include "synthetic/dataset/truth.h"

#include <filesystem>
#include <string>

namespace pelvireg::dataset::testing
{
Anatomy sample_anatomy();
Truth sample_truth();
Observations sample_observations();
Estimate sample_estimate();

/// An empty folder of its own for one test, removed at the end.
class ScratchFolder
{
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;
  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }
  const std::filesystem::path &path() const { return path_; }

private:
  std::filesystem::path path_;
};

std::string bytes_of(const std::filesystem::path &file);
} // namespace pelvireg::dataset::testing
