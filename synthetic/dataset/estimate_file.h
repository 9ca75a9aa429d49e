// Estimates run by run, so that no more than one run need be in memory, and parts of estimates.
#pragma once

#include "synthetic/dataset/estimate.h"
#include "synthetic/dataset/store.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::dataset
{
/// Wall time of the steps of one run, ms. Not the same from run to run, so it is in parts alone and in no estimate.
struct StepTimes
{
  std::vector<double> step_ms;
  std::vector<std::string> phases;           ///< names of what a step consists of, in the order of a step
  std::vector<std::vector<double>> phase_ms; ///< of every phase, as many as step_ms
};

/// What a part of an estimate says beside its runs: which of how many they are, and what they were made from. A part is
/// a file of its own format, so that nobody takes it for the whole.
struct EstimatePart
{
  std::int32_t samples = 0;             ///< randomised runs of the whole estimate
  std::int32_t shard = 1, n_shards = 1; ///< the part holds the runs k with k mod n_shards = shard - 1
  std::string anatomy_sha256, observations_sha256;
  std::string program_sha256; ///< over the sources behind the runs and the compiler
  StepTimes nominal_times;    ///< of the nominal run; empty when it is not in the part
};

/// An estimate being written. The bytes depend on what was added alone, not on when and by whom.
class EstimateWriter
{
public:
  /// `description` without its samples; `rest_surfaces` are those of the nominal run, without positions. With `part`
  /// the file is a part.
  EstimateWriter(const std::filesystem::path &file, const Estimate &description,
                 const std::vector<EstimateSurface> &rest_surfaces, const EstimatePart *part = nullptr);
  /// Runs in ascending order. Throws ComputationError for a run that does not ascend, has another rest surface
  /// (other points are allowed when surfaces are perturbed), or not one position a step.
  void add(const EstimateSample &sample);
  /// The file appears under its name.
  void finish();

private:
  StoreWriter file_;
  std::vector<EstimateSurface> rest_surfaces_;
  std::size_t n_pairs_;
  bool moves_surfaces_;
  std::vector<std::int32_t> numbers_;
  std::optional<GroupWriter> samples_;
};

/// An estimate being read. Failures are InputErrors that name file and dataset.
class EstimateReader
{
public:
  enum class Kind
  {
    whole,
    part
  };
  explicit EstimateReader(const std::filesystem::path &file, Kind kind = Kind::whole);

  /// Everything but the samples.
  const Estimate &description() const { return description_; }
  /// Of the nominal run, without positions.
  const std::vector<EstimateSurface> &rest_surfaces() const { return rest_surfaces_; }
  /// Numbers of the runs, ascending.
  const std::vector<std::int32_t> &numbers() const { return numbers_; }
  /// Of a part only.
  const EstimatePart &part() const { return part_; }
  EstimateSample sample(std::int32_t number) const;

private:
  StoreReader file_;
  Estimate description_;
  std::vector<EstimateSurface> rest_surfaces_;
  std::vector<std::int32_t> numbers_;
  EstimatePart part_;
};
} // namespace pelvireg::dataset
