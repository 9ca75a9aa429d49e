#include "validation/runner/part_store.h"

#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace pelvireg::runner
{
using dataset::EstimateReader;

PartStore::PartStore(std::filesystem::path folder, dataset::Estimate description,
                     std::vector<dataset::EstimateSurface> rest_surfaces, dataset::EstimatePart origin)
    : folder_(std::move(folder)), description_(std::move(description)), rest_surfaces_(std::move(rest_surfaces)),
      origin_(std::move(origin))
{
  std::filesystem::create_directories(folder_);
}

std::filesystem::path PartStore::file_of(int run) const
{
  return folder_ / fmt::format("{:04}.h5", run);
}

bool PartStore::has(int run) const
{
  if (!std::filesystem::exists(file_of(run)))
    return false;
  try
  {
    const EstimateReader reader(file_of(run), EstimateReader::Kind::part);
    return is_from(reader, description_, origin_) && reader.numbers() == std::vector<std::int32_t>{run};
  }
  catch (const InputError &)
  {
    return false; // damaged: played again
  }
}

void PartStore::save(const dataset::EstimateSample &run, const dataset::StepTimes &times) const
{
  dataset::EstimatePart part = origin_;
  if (run.sample == 0)
    part.nominal_times = times;
  dataset::EstimateWriter writer(file_of(run.sample), description_, rest_surfaces_, &part);
  writer.add(run);
  writer.finish();
}

dataset::EstimateSample PartStore::load(int run) const
{
  return EstimateReader(file_of(run), EstimateReader::Kind::part).sample(run);
}

dataset::StepTimes PartStore::nominal_times() const
{
  return has(0) ? EstimateReader(file_of(0), EstimateReader::Kind::part).part().nominal_times : dataset::StepTimes{};
}

void PartStore::assemble(const std::vector<int> &runs, const std::filesystem::path &file,
                         const dataset::EstimatePart *part) const
{
  dataset::EstimateWriter writer(file, description_, rest_surfaces_, part);
  for (const int run : runs)
    writer.add(load(run));
  writer.finish();
}

void PartStore::remove(const std::vector<int> &runs) const
{
  std::error_code ignored;
  for (const int run : runs)
    std::filesystem::remove(file_of(run), ignored);
}

bool is_from(const EstimateReader &part, const dataset::Estimate &description, const dataset::EstimatePart &origin)
{
  const dataset::Estimate &own = part.description();
  return own.case_name == description.case_name && own.condition == description.condition &&
         own.perturbation == description.perturbation && own.contact_pairs == description.contact_pairs &&
         part.part().anatomy_sha256 == origin.anatomy_sha256 &&
         part.part().observations_sha256 == origin.observations_sha256 &&
         part.part().program_sha256 == origin.program_sha256;
}
} // namespace pelvireg::runner
