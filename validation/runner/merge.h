// The shards of one set of runs become its estimate.
#pragma once

#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/estimate_file.h"

#include <filesystem>
#include <vector>

namespace pelvireg::runner
{
/// What the shards of one set of runs agree on.
struct ShardSet
{
  dataset::Estimate description;            ///< without samples
  dataset::EstimatePart origin;             ///< with the times of the nominal run's steps
  std::vector<std::filesystem::path> files; ///< shard 1 … n
};

/// Read the heads of the shards, in any order. Throws InputError, one sentence, when they are not one set: another
/// case, condition, perturbation, magnitude, seed, number of runs or shards, another anatomy, observations or program;
/// a shard that is missing, there twice or without one of its runs.
ShardSet read_shards(const std::vector<std::filesystem::path> &files);

/// Write the estimate: the same bytes as one register of all runs. One run is in memory at a time.
void merge_shards(const ShardSet &shards, const std::filesystem::path &file);
} // namespace pelvireg::runner
