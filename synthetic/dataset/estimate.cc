#include "synthetic/dataset/estimate.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"

#include <cstdio>

namespace pelvireg::dataset
{
namespace
{
constexpr const char *format = "pelvireg estimate";

std::string sample_group(std::int32_t sample)
{
  char name[16];
  std::snprintf(name, sizeof name, "%04d", sample);
  return name;
}

/// Samples differ in stiffness only, so one rest surface an organ serves them all.
void require_common_rest(const Estimate &estimate)
{
  for (const EstimateSample &sample : estimate.samples)
  {
    const std::vector<EstimateSurface> &first = estimate.samples[0].surfaces;
    bool is_common = sample.surfaces.size() == first.size();
    for (std::size_t i = 0; is_common && i < first.size(); ++i)
      is_common = sample.surfaces[i].name == first[i].name && sample.surfaces[i].rest.points == first[i].rest.points &&
                  sample.surfaces[i].rest.triangles == first[i].rest.triangles &&
                  sample.surfaces[i].rest.region == first[i].rest.region &&
                  sample.surfaces[i].positions.size() == sample.steps.size();
    if (!is_common)
      throw ComputationError("cannot store sample " + std::to_string(sample.sample) +
                             ": it has another rest surface than the first, or not one position a step");
  }
}

template <typename Value, typename Field> std::vector<Value> column(const std::vector<StepRecord> &steps, Field field)
{
  std::vector<Value> values;
  for (const StepRecord &step : steps)
    values.push_back(step.*field);
  return values;
}

void write_steps(GroupWriter group, const std::vector<StepRecord> &steps)
{
  group.texts("status", column<std::string>(steps, &StepRecord::status));
  group.integers("offered_control_points", column<std::int32_t>(steps, &StepRecord::offered_control_points));
  group.integers("accepted_control_points", column<std::int32_t>(steps, &StepRecord::accepted_control_points));
  group.numbers("in_plane_residual", column<double>(steps, &StepRecord::in_plane_residual));
  group.numbers("max_in_plane_residual", column<double>(steps, &StepRecord::max_in_plane_residual));
  group.numbers("attachment_residual", column<double>(steps, &StepRecord::attachment_residual));
  group.numbers("out_of_plane_force", column<double>(steps, &StepRecord::out_of_plane_force));
  group.numbers("in_plane_force", column<double>(steps, &StepRecord::in_plane_force));
  group.integers("solver_sweeps", column<std::int32_t>(steps, &StepRecord::solver_sweeps));
}

std::vector<StepRecord> read_steps(const GroupReader &group)
{
  const auto status = group.texts("status");
  const auto count = static_cast<std::int64_t>(status.size());
  const auto offered = group.integers("offered_control_points", count);
  const auto accepted = group.integers("accepted_control_points", count);
  const auto residual = group.numbers("in_plane_residual", count);
  const auto max_residual = group.numbers("max_in_plane_residual", count);
  const auto attachment = group.numbers("attachment_residual", count);
  const auto out_of_plane = group.numbers("out_of_plane_force", count);
  const auto in_plane = group.numbers("in_plane_force", count);
  const auto sweeps = group.integers("solver_sweeps", count);
  std::vector<StepRecord> steps;
  for (std::size_t i = 0; i < status.size(); ++i)
    steps.push_back({.status = status[i],
                     .offered_control_points = offered[i],
                     .accepted_control_points = accepted[i],
                     .in_plane_residual = residual[i],
                     .max_in_plane_residual = max_residual[i],
                     .attachment_residual = attachment[i],
                     .out_of_plane_force = out_of_plane[i],
                     .in_plane_force = in_plane[i],
                     .solver_sweeps = sweeps[i]});
  return steps;
}

void write_sample(GroupWriter group, const EstimateSample &sample)
{
  write_steps(group.group("steps"), sample.steps);
  GroupWriter positions = group.group("positions");
  for (const EstimateSurface &surface : sample.surfaces)
    positions.stack(surface.name, surface.positions);
}

EstimateSample read_sample(const GroupReader &group, std::int32_t number,
                           const std::vector<EstimateSurface> &rest_surfaces)
{
  EstimateSample sample;
  sample.sample = number;
  sample.steps = read_steps(group.group("steps"));
  sample.surfaces = rest_surfaces;
  const GroupReader positions = group.group("positions");
  for (EstimateSurface &surface : sample.surfaces)
    surface.positions =
        positions.stack(surface.name, static_cast<std::int64_t>(sample.steps.size()), surface.rest.points.rows());
  return sample;
}

void write_rest_surfaces(GroupWriter group, const Estimate &estimate)
{
  std::vector<std::string> names;
  if (!estimate.samples.empty())
    for (const EstimateSurface &surface : estimate.samples[0].surfaces)
    {
      names.push_back(surface.name);
      GroupWriter entry = group.group(surface.name);
      write_surface(entry, surface.rest);
    }
  group.texts("names", names);
}

std::vector<EstimateSurface> read_rest_surfaces(const GroupReader &group)
{
  std::vector<EstimateSurface> surfaces;
  for (const std::string &name : group.texts("names"))
    surfaces.push_back({name, read_surface(group.group(name)), {}});
  return surfaces;
}
} // namespace

void save(const Estimate &estimate, const std::filesystem::path &file)
{
  require_common_rest(estimate);
  StoreWriter writer(file, format);
  GroupWriter &root = writer.root();
  root.text("case_name", estimate.case_name);
  root.text("condition", estimate.condition);
  write_rest_surfaces(root.group("surfaces"), estimate);
  std::vector<std::int32_t> numbers;
  GroupWriter samples = root.group("samples");
  for (const EstimateSample &sample : estimate.samples)
  {
    numbers.push_back(sample.sample);
    write_sample(samples.group(sample_group(sample.sample)), sample);
  }
  samples.integers("numbers", numbers);
  writer.finish();
}

Estimate load_estimate(const std::filesystem::path &file)
{
  const StoreReader reader(file, format);
  const GroupReader &root = reader.root();
  Estimate estimate;
  estimate.case_name = root.text("case_name");
  estimate.condition = root.text("condition");
  const std::vector<EstimateSurface> rest_surfaces = read_rest_surfaces(root.group("surfaces"));
  const GroupReader samples = root.group("samples");
  const Integers numbers = samples.array<Integers>("numbers");
  for (const std::int32_t number : numbers)
    estimate.samples.push_back(read_sample(samples.group(sample_group(number)), number, rest_surfaces));
  return estimate;
}
} // namespace pelvireg::dataset
