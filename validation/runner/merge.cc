#include "validation/runner/merge.h"

#include "synthetic/dataset/error.h"
#include "validation/runner/register.h"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace pelvireg::runner
{
namespace
{
using dataset::EstimateReader;

/// What two shards of one set of runs must agree on, as words.
std::vector<std::pair<std::string, std::string>> identity_of(const EstimateReader &shard)
{
  const dataset::Estimate &estimate = shard.description();
  const dataset::Perturbation &perturbation = estimate.perturbation;
  const dataset::EstimatePart &part = shard.part();
  return {{"case", estimate.case_name},
          {"condition", estimate.condition},
          {"perturbation", perturbation.kind},
          {"seed", std::to_string(perturbation.seed)},
          {"spread", fmt::format("{}", perturbation.modulus_spread)},
          {"surface noise (mm)", fmt::format("{}", perturbation.surface_sd)},
          {"correlation length (mm)", fmt::format("{}", perturbation.surface_correlation_length)},
          {"outline noise (mm)", fmt::format("{}", perturbation.outline_sd)},
          {"plane offset (mm)", fmt::format("{}", perturbation.plane_offset_sd)},
          {"plane tilt (rad)", fmt::format("{}", perturbation.plane_tilt_sd)},
          {"number of randomised runs", std::to_string(part.samples)},
          {"number of shards", std::to_string(part.n_shards)},
          {"anatomy.h5 (SHA-256)", part.anatomy_sha256},
          {"observations.h5 (SHA-256)", part.observations_sha256},
          {"program (SHA-256)", part.program_sha256}};
}

void require_same_set(const EstimateReader &first, const std::filesystem::path &first_file, const EstimateReader &other,
                      const std::filesystem::path &other_file)
{
  const auto wanted = identity_of(first), got = identity_of(other);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (got[i].second != wanted[i].second)
      throw InputError(fmt::format("merge: '{}' has {} {}, '{}' has {}; merge shards of one set of runs",
                                   other_file.string(), got[i].first, got[i].second, first_file.string(),
                                   wanted[i].second));
}

void require_its_runs(const EstimateReader &shard, const std::filesystem::path &file)
{
  const dataset::EstimatePart &part = shard.part();
  if (part.samples < 0 || part.n_shards < 1 || part.shard < 1 || part.shard > part.n_shards)
    throw InputError(fmt::format("merge: '{}' says that it is shard {} of {} with {} randomised runs; register that "
                                 "shard again",
                                 file.string(), part.shard, part.n_shards, part.samples));
  if (shard.numbers() != runs_of_shard(part.samples, {part.shard, part.n_shards}))
    throw InputError(fmt::format("merge: '{}' does not hold the runs of shard {} of {}; register that shard again",
                                 file.string(), part.shard, part.n_shards));
}
} // namespace

ShardSet read_shards(const std::vector<std::filesystem::path> &files)
{
  if (files.empty())
    throw InputError("merge: no shard was given; make them with 'pelvireg register DIR --shard i/n'");
  const EstimateReader first(files.front(), EstimateReader::Kind::part);
  require_its_runs(first, files.front());
  ShardSet set{first.description(), first.part(), {}};
  set.files.resize(static_cast<std::size_t>(set.origin.n_shards));
  for (const std::filesystem::path &file : files)
  {
    const EstimateReader shard(file, EstimateReader::Kind::part);
    require_same_set(first, files.front(), shard, file);
    require_its_runs(shard, file);
    std::filesystem::path &place = set.files[static_cast<std::size_t>(shard.part().shard) - 1];
    if (!place.empty())
      throw InputError(fmt::format("merge: shard {} of {} is there twice, as '{}' and as '{}'; give each shard once",
                                   shard.part().shard, set.origin.n_shards, place.string(), file.string()));
    place = file;
    if (shard.part().shard == 1)
      set.origin.nominal_times = shard.part().nominal_times;
  }
  for (std::size_t i = 0; i < set.files.size(); ++i)
    if (set.files[i].empty())
      throw InputError(fmt::format("merge: shard {} of {} of '{}' is missing, all are needed; make it with 'pelvireg "
                                   "register DIR --shard {}/{}' and the options of the others",
                                   i + 1, set.files.size(), set.description.label(), i + 1, set.files.size()));
  return set;
}

void merge_shards(const ShardSet &shards, const std::filesystem::path &file)
{
  std::vector<std::unique_ptr<EstimateReader>> readers;
  for (const std::filesystem::path &shard : shards.files)
    readers.push_back(std::make_unique<EstimateReader>(shard, EstimateReader::Kind::part));
  dataset::EstimateWriter writer(file, shards.description, readers.front()->rest_surfaces());
  for (int run = 0; run <= shards.origin.samples; ++run)
    writer.add(readers[static_cast<std::size_t>(run) % readers.size()]->sample(run));
  writer.finish();
}
} // namespace pelvireg::runner
