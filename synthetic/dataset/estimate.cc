#include "synthetic/dataset/estimate.h"

#include "synthetic/dataset/error.h"
#include "synthetic/dataset/store.h"

#include <cstddef>
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

/// One row a step, one column a pair, row after row.
std::vector<double> flattened(const std::vector<StepRecord> &steps, std::vector<double> StepRecord::*field,
                              std::size_t n_pairs)
{
  std::vector<double> values;
  for (const StepRecord &step : steps)
  {
    if ((step.*field).size() != n_pairs)
      throw ComputationError("cannot store a step with penetrations of " + std::to_string((step.*field).size()) +
                             " pairs: the estimate has " + std::to_string(n_pairs));
    values.insert(values.end(), (step.*field).begin(), (step.*field).end());
  }
  return values;
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

void write_steps(GroupWriter group, const std::vector<StepRecord> &steps, std::size_t n_pairs)
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
  group.integers("contacts", column<std::int32_t>(steps, &StepRecord::contacts));
  group.numbers("contact_force", column<double>(steps, &StepRecord::contact_force));
  group.numbers("contact_residual", column<double>(steps, &StepRecord::contact_residual));
  group.numbers("friction_cone_violation", column<double>(steps, &StepRecord::friction_cone_violation));
  group.integers("open_rays", column<std::int32_t>(steps, &StepRecord::open_rays));
  group.numbers("penetration_depth", flattened(steps, &StepRecord::penetration_depth, n_pairs));
  group.numbers("penetration_volume", flattened(steps, &StepRecord::penetration_volume, n_pairs));
}

std::vector<StepRecord> read_steps(const GroupReader &group, std::size_t n_pairs)
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
  const auto contacts = group.integers("contacts", count);
  const auto contact_force = group.numbers("contact_force", count);
  const auto contact_residual = group.numbers("contact_residual", count);
  const auto cone_violation = group.numbers("friction_cone_violation", count);
  const auto open_rays = group.integers("open_rays", count);
  const auto depths = group.numbers("penetration_depth", count * static_cast<std::int64_t>(n_pairs));
  const auto volumes = group.numbers("penetration_volume", count * static_cast<std::int64_t>(n_pairs));
  const auto of_step = [n_pairs](const std::vector<double> &values, std::size_t step)
  {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(step * n_pairs);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(n_pairs));
  };
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
                     .solver_sweeps = sweeps[i],
                     .contacts = contacts[i],
                     .contact_force = contact_force[i],
                     .contact_residual = contact_residual[i],
                     .friction_cone_violation = cone_violation[i],
                     .open_rays = open_rays[i],
                     .penetration_depth = of_step(depths, i),
                     .penetration_volume = of_step(volumes, i)});
  return steps;
}

void write_sample(GroupWriter group, const EstimateSample &sample, std::size_t n_pairs)
{
  write_steps(group.group("steps"), sample.steps, n_pairs);
  GroupWriter positions = group.group("positions");
  for (const EstimateSurface &surface : sample.surfaces)
    positions.stack(surface.name, surface.positions);
}

EstimateSample read_sample(const GroupReader &group, std::int32_t number,
                           const std::vector<EstimateSurface> &rest_surfaces, std::size_t n_pairs)
{
  EstimateSample sample;
  sample.sample = number;
  sample.steps = read_steps(group.group("steps"), n_pairs);
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

void write_contact_pairs(GroupWriter group, const Estimate &estimate)
{
  std::vector<std::string> first, second;
  for (const auto &[a, b] : estimate.contact_pairs)
  {
    first.push_back(a);
    second.push_back(b);
  }
  group.texts("organ_a", first);
  group.texts("organ_b", second);
}

std::vector<std::pair<std::string, std::string>> read_contact_pairs(const GroupReader &group)
{
  const std::vector<std::string> first = group.texts("organ_a"), second = group.texts("organ_b");
  if (first.size() != second.size())
    group.refuse("organ_b",
                 "has " + std::to_string(second.size()) + " names, organ_a has " + std::to_string(first.size()));
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i)
    pairs.emplace_back(first[i], second[i]);
  return pairs;
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
  write_contact_pairs(root.group("contact_pairs"), estimate);
  std::vector<std::int32_t> numbers;
  GroupWriter samples = root.group("samples");
  for (const EstimateSample &sample : estimate.samples)
  {
    numbers.push_back(sample.sample);
    write_sample(samples.group(sample_group(sample.sample)), sample, estimate.contact_pairs.size());
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
  estimate.contact_pairs = read_contact_pairs(root.group("contact_pairs"));
  const GroupReader samples = root.group("samples");
  const Integers numbers = samples.array<Integers>("numbers");
  for (const std::int32_t number : numbers)
    estimate.samples.push_back(
        read_sample(samples.group(sample_group(number)), number, rest_surfaces, estimate.contact_pairs.size()));
  return estimate;
}
} // namespace pelvireg::dataset
