#include "synthetic/dataset/estimate_steps.h"

#include "synthetic/dataset/error.h"

#include <cstdint>
#include <string>

namespace pelvireg::dataset
{
namespace
{
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

template <typename Value, typename Field> std::vector<Value> column(const std::vector<StepRecord> &steps, Field field)
{
  std::vector<Value> values;
  for (const StepRecord &step : steps)
    values.push_back(step.*field);
  return values;
}
} // namespace

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
} // namespace pelvireg::dataset
