// Finished runs on disk, so that a register that was killed goes on where it was.
#pragma once

#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/estimate_file.h"

#include <filesystem>
#include <vector>

namespace pelvireg::runner
{
/// A folder with one file a run, NNNN.h5, each whole or absent. A file that is damaged or was made from something else
/// counts as absent. HDF5 is not thread safe: one call at a time.
class PartStore
{
public:
  /// Makes the folder when it is missing. `origin`: what the runs are made from; shard numbers in it mean nothing here.
  PartStore(std::filesystem::path folder, dataset::Estimate description,
            std::vector<dataset::EstimateSurface> rest_surfaces, dataset::EstimatePart origin);

  bool has(int run) const;
  void save(const dataset::EstimateSample &run, const dataset::StepTimes &times) const;
  /// Throws InputError when it is not there.
  dataset::EstimateSample load(int run) const;
  /// Of the nominal run; empty when it is not there.
  dataset::StepTimes nominal_times() const;

  /// All of `runs` as one file: a part of the estimate when `part` is given, else the whole.
  void assemble(const std::vector<int> &runs, const std::filesystem::path &file,
                const dataset::EstimatePart *part = nullptr) const;
  /// Remove these runs. The folder stays: other processes may be about to write in it.
  void remove(const std::vector<int> &runs) const;

private:
  std::filesystem::path file_of(int run) const;

  std::filesystem::path folder_;
  dataset::Estimate description_;
  std::vector<dataset::EstimateSurface> rest_surfaces_;
  dataset::EstimatePart origin_;
};

/// Does a part hold runs of this description, made from the same anatomy, observations and program?
bool is_from(const dataset::EstimateReader &part, const dataset::Estimate &description,
             const dataset::EstimatePart &origin);
} // namespace pelvireg::runner
