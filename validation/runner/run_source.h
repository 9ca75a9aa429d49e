// The runs of an estimate, one at a time: no more of them need be in memory than are looked at.
#pragma once

#include "synthetic/dataset/estimate.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pelvireg::runner
{
struct RunSource
{
  dataset::Estimate description;     ///< without its samples
  std::vector<std::int32_t> numbers; ///< of its runs
  /// The run numbers[i]. May be called by several threads.
  std::function<std::shared_ptr<const dataset::EstimateSample>(std::size_t i)> run;
};

/// Of an estimate in memory, which must outlive the source.
RunSource runs_of(const dataset::Estimate &estimate);

/// Of estimate-LABEL.h5, which stays open; a run is read when it is asked for. Failures are InputErrors that name file
/// and dataset.
RunSource runs_in(const std::filesystem::path &file);
} // namespace pelvireg::runner
