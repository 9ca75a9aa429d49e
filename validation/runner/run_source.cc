#include "validation/runner/run_source.h"

#include "synthetic/dataset/estimate_file.h"

#include <mutex>

namespace pelvireg::runner
{
namespace
{
std::mutex reading; // Debian's HDF5 bears one thread at a time, whatever the file
} // namespace

RunSource runs_of(const dataset::Estimate &estimate)
{
  RunSource source{.description = {.case_name = estimate.case_name,
                                   .condition = estimate.condition,
                                   .samples = {},
                                   .contact_pairs = estimate.contact_pairs,
                                   .perturbation = estimate.perturbation},
                   .numbers = {},
                   .run = {}};
  for (const dataset::EstimateSample &sample : estimate.samples)
    source.numbers.push_back(sample.sample);
  source.run = [&estimate](std::size_t i)
  { return std::shared_ptr<const dataset::EstimateSample>(std::shared_ptr<void>(), &estimate.samples[i]); };
  return source;
}

RunSource runs_in(const std::filesystem::path &file)
{
  const std::lock_guard lock(reading);
  const auto reader = std::make_shared<const dataset::EstimateReader>(file);
  return {.description = reader->description(),
          .numbers = reader->numbers(),
          .run = [reader](std::size_t i)
          {
            const std::lock_guard lock_run(reading);
            return std::make_shared<const dataset::EstimateSample>(reader->sample(reader->numbers()[i]));
          }};
}
} // namespace pelvireg::runner
