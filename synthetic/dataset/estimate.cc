#include "synthetic/dataset/estimate.h"

#include "synthetic/dataset/estimate_file.h"

namespace pelvireg::dataset
{
void save(const Estimate &estimate, const std::filesystem::path &file)
{
  std::vector<EstimateSurface> rest_surfaces;
  if (!estimate.samples.empty())
    for (const EstimateSurface &surface : estimate.samples.front().surfaces)
      rest_surfaces.push_back({surface.name, surface.rest, {}});
  EstimateWriter writer(file, estimate, rest_surfaces);
  for (const EstimateSample &sample : estimate.samples)
    writer.add(sample);
  writer.finish();
}

Estimate load_estimate(const std::filesystem::path &file)
{
  const EstimateReader reader(file);
  Estimate estimate = reader.description();
  for (const std::int32_t number : reader.numbers())
    estimate.samples.push_back(reader.sample(number));
  return estimate;
}

Estimate load_first_run(const std::filesystem::path &file)
{
  const EstimateReader reader(file);
  Estimate estimate = reader.description();
  if (!reader.numbers().empty())
    estimate.samples.push_back(reader.sample(reader.numbers().front()));
  return estimate;
}
} // namespace pelvireg::dataset
