// The register stage: all runs of one condition, or one shard of them, killed and resumed at will; and merge.
#pragma once

#include "synthetic/dataset/estimate.h"
#include "validation/cli/stage_cache.h"
#include "validation/runner/register.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// The randomised runs of the registration, as the command line gives them.
struct SampleSettings
{
  int samples = 0; ///< beside the nominal run
  std::uint64_t seed = 1;
  std::vector<std::string> kinds = {"modulus"}; ///< of perturbations, one at a time
  /// Magnitudes that were given. Those of a kind that is not perturbed are refused.
  std::optional<double> spread, surface_sd, correlation_length, outline_sd, plane_offset_sd; ///< –, mm
  std::optional<double> plane_tilt_sd_degrees;

  /// One a kind. Throws InputError for a magnitude out of range or of another kind, and for a kind without runs.
  std::vector<dataset::Perturbation> perturbations() const;
};

/// What is to be registered.
struct RegisterRequest
{
  std::string condition;
  dataset::Perturbation perturbation;
  int samples = 0;
};

/// Every condition with every perturbation.
std::vector<RegisterRequest> requests_of(const std::vector<std::string> &conditions, const SampleSettings &settings);

/// The nominal run of every condition, driven by tracked.h5 instead of observations.h5.
std::vector<RegisterRequest> tracked_requests_of(const std::vector<std::string> &conditions);

/// estimate-LABEL.h5. Runs that a killed register left behind are not played again.
void make_estimate(ResultDirectory &directory, const RegisterRequest &request, int jobs);

/// shard-LABEL-i-of-n.h5, beside other processes on other shards: the directory is open for reading.
void make_shard(ResultDirectory &directory, const RegisterRequest &request, const runner::Shard &shard, int jobs);

/// estimate-LABEL.h5 from shards: `files`, or all in the directory when there are none. Throws InputError when they do
/// not belong together or to what is in the directory.
void merge_estimates(ResultDirectory &directory, std::vector<std::filesystem::path> files);

/// Labels of all estimates that there can be, in the order of tables.
std::vector<std::string> estimate_labels();
} // namespace pelvireg::cli
