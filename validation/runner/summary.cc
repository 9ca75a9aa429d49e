#include "synthetic/dataset/geometry.h"
#include "validation/runner/aggregate.h"
#include "validation/runner/aims.h"
#include "validation/runner/claims.h"
#include "validation/runner/node_table.h"
#include "validation/runner/result_files.h"
#include "validation/runner/table_one.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace pelvireg::runner
{
namespace
{
using dataset::organ_names;
using json = nlohmann::ordered_json;

json to_json(const Aggregate &aggregate)
{
  return {{"n_runs", aggregate.n_runs}, {"mean_mm", aggregate.mean}, {"sd_mm", aggregate.sd}};
}

json to_json(const std::optional<Slope> &slope)
{
  if (!slope)
    return nullptr;
  return {{"mm_per_mm", slope->value}, {"n_slices", slope->n_slices}, {"n_slices_left_out", slope->n_left_out}};
}

/// The distribution over the surface samples in the nominal run at the last step.
json nominal_distribution(const Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  for (const StepError &row : evaluation.by_step)
    if (row.condition == condition && row.organ == organ && row.sample == 0 && row.step == evaluation.n_steps())
      return {{"n_points", row.distance.n},
              {"mean_mm", row.distance.mean},
              {"sd_mm", row.distance.sd},
              {"p95_mm", row.distance.p95},
              {"max_mm", row.distance.max}};
  return nullptr;
}

json slices(const Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  json list = json::array();
  const auto errors = error_by_slice(evaluation, condition, organ);
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    if (!errors[i])
      continue;
    json slice = to_json(*errors[i]);
    slice["slice_index"] = static_cast<int>(i) - evaluation.n_slices_each_side;
    list.push_back(slice);
  }
  return list;
}

json organ_errors(const Evaluation &evaluation, const std::string &condition, const std::string &organ)
{
  const auto by_step = error_by_step(evaluation, condition, organ);
  const auto worst = std::max_element(by_step.begin(), by_step.end(),
                                      [](const Aggregate &a, const Aggregate &b) { return a.mean < b.mean; });
  const double nothing = error_by_step(evaluation, unregistered, organ).back().mean;
  json result;
  result["last_step"] = to_json(by_step.back());
  result["last_step_nominal_run"] = nominal_distribution(evaluation, condition, organ);
  result["largest_over_steps"] = to_json(*worst);
  result["largest_over_steps"]["step"] = worst - by_step.begin() + 1;
  if (condition != unregistered && nothing > 0)
    result["reduction_against_unregistered_percent"] = 100 * (1 - by_step.back().mean / nothing);
  result["last_step_by_slice"] = slices(evaluation, condition, organ);
  result["slope_with_distance"] = to_json(slope_with_distance(evaluation, condition, organ));
  result["slope_with_distance_of_all_slices"] = to_json(slope_with_distance(evaluation, condition, organ, true));
  return result;
}

json errors(const Evaluation &evaluation)
{
  json result;
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : organ_names)
      result[condition][organ] = organ_errors(evaluation, condition, organ);
  return result;
}

/// Beyond surface distance, at the last step.
json metrics_at_last_step(const Evaluation &evaluation)
{
  json result;
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : organ_names)
      for (const MetricFigure &figure : metric_figures())
        if (const auto value = metric_at_last_step(evaluation, condition, organ, figure))
          result[condition][organ][figure.name] = {{"n_runs", value->n_runs}, {"mean", value->mean}, {"sd", value->sd}};
  return result;
}

json by_distance(const Evaluation &evaluation)
{
  json result;
  for (const std::string &condition : evaluation.conditions)
    for (const std::string &organ : organ_names)
    {
      json slabs = json::array();
      for (const DistanceAggregate &slab : error_by_distance(evaluation, condition, organ))
        slabs.push_back({{"offset_from_mm", (slab.bin - 0.5) * evaluation.slice_pitch},
                         {"offset_to_mm", (slab.bin + 0.5) * evaluation.slice_pitch},
                         {"surface", to_json(slab.surface)},
                         {"material", to_json(slab.material)}});
      result[condition][organ] = slabs;
    }
  return result;
}

json sections(const Evaluation &evaluation)
{
  json list = json::array();
  for (const TruthSection &section : evaluation.sections)
    list.push_back({{"organ", section.organ},
                    {"slice_index", section.slice_index},
                    {"area_mm2", section.area},
                    {"share_of_largest", section.share},
                    {"counts_for_slope", counts_for_growth(evaluation, section.organ, section.slice_index)}});
  return list;
}

/// The worst over the runs of a condition, one entry a body.
json elements(const Evaluation &evaluation)
{
  json result = json::object();
  for (const BodyElements &run : evaluation.elements)
  {
    json &body = result[run.condition][run.body];
    if (body.is_null())
      body = {{"n_elements", run.jacobian.n_elements}, {"n_runs", 0}, {"n_inverted", 0}};
    body["n_runs"] = body["n_runs"].get<int>() + 1;
    body["n_inverted"] = body["n_inverted"].get<int>() + run.jacobian.n_inverted;
    if (!body.contains("smallest_jacobian") || run.jacobian.smallest < body["smallest_jacobian"].get<double>())
    {
      body["smallest_jacobian"] = run.jacobian.smallest;
      body["sample_of_smallest"] = run.sample;
    }
  }
  return result;
}

json motion(const Evaluation &evaluation)
{
  json result;
  result["mean_vaginal_in_plane_displacement_mm"] = evaluation.vaginal_displacement;
  result["mean_vaginal_in_plane_displacement_reported_by_truth_mm"] = evaluation.reported_vaginal_displacement;
  for (const OrganMotion &organ : evaluation.motion)
    result["organs"][organ.organ] = {{"mean_mm", organ.mean},
                                     {"max_mm", organ.max},
                                     {"mean_off_plane_mm", organ.mean_off_plane},
                                     {"max_off_plane_mm", organ.max_off_plane},
                                     {"mesh_difference_at_rest_mm", organ.mesh_difference.mean}};
  return result;
}

json quality(const Evaluation &evaluation)
{
  json list = json::array();
  for (const RunQuality &run : evaluation.quality)
    list.push_back({{"condition", run.condition},
                    {"sample", run.sample},
                    {"n_steps", run.n_steps},
                    {"n_failed_steps", run.n_failed_steps},
                    {"least_acceptance", run.least_acceptance},
                    {"largest_mean_residual_mm", run.largest_mean_residual},
                    {"largest_residual_mm", run.largest_residual},
                    {"largest_out_of_plane_force_n", run.largest_out_of_plane_force},
                    {"largest_in_plane_force_n", run.largest_in_plane_force},
                    {"mean_outline_constraints", run.mean_outline_constraints},
                    {"mean_contacts", run.mean_contacts}});
  return list;
}

json penetrations(const Evaluation &evaluation)
{
  json list = json::array();
  for (const OrganPenetration &pair : evaluation.penetrations)
    list.push_back({{"condition", pair.condition},
                    {"sample", pair.sample},
                    {"organ_a", pair.organ_a},
                    {"organ_b", pair.organ_b},
                    {"attached", pair.is_attached},
                    {"deepest_mm", pair.deepest},
                    {"step_of_deepest", pair.step_of_deepest},
                    {"last_step_mm", pair.last},
                    {"largest_volume_mm3", pair.largest_volume},
                    {"last_step_volume_mm3", pair.last_volume}});
  return list;
}

/// Beside the column of Table 1 that has the size; null without one.
json registration_nodes(const Evaluation &evaluation)
{
  const TableOneColumn *column = table_one_column(evaluation.n_registration_nodes());
  json bodies = json::array();
  for (const BodySize &size : evaluation.registration_nodes)
  {
    const int wanted = table_one_nodes(evaluation.registration_nodes, size.body);
    bodies.push_back({{"body", size.body},
                      {"n_nodes", size.n_nodes},
                      {"table_1", wanted > 0 ? json(wanted) : json()},
                      {"difference_percent", wanted > 0 ? json(100.0 * (size.n_nodes - wanted) / wanted) : json()}});
  }
  return {{"table_1_data_set", column ? json(column->data_set) : json()}, {"bodies", bodies}};
}

json missed(const Evaluation &evaluation)
{
  json list = json::array();
  for (const MissedSlice &slice : evaluation.missed_slices)
    list.push_back({{"condition", slice.condition},
                    {"sample", slice.sample},
                    {"organ", slice.organ},
                    {"slice_index", slice.slice_index},
                    {"truth_contour_mm", slice.truth_length}});
  return list;
}
json timing_list(const std::vector<StepTiming> &timings)
{
  json list = json::array();
  for (const StepTiming &timing : timings)
  {
    json phases = json::array();
    for (const PhaseTiming &phase : timing.phases)
      phases.push_back({{"phase", phase.name}, {"mean_ms", phase.mean_ms}});
    list.push_back({{"condition", timing.condition},
                    {"n_steps", timing.n_steps},
                    {"median_ms", timing.median_ms},
                    {"p95_ms", timing.p95_ms},
                    {"max_ms", timing.max_ms},
                    {"mean_ms", timing.mean_ms},
                    {"phases", phases}});
  }
  return list;
}
} // namespace

std::string summary_json(const Evaluation &evaluation, const std::vector<StepTiming> &timings)
{
  json summary;
  summary["format"] = "pelvireg summary";
  summary["format_version"] = "1.0";
  summary["units"] = "mm";
  summary["case"] = evaluation.case_name;
  summary["truth"] = evaluation.truth_source;
  summary["inverse_crime"] = evaluation.is_inverse_crime;
  if (evaluation.is_inverse_crime)
    summary["notice"] = inverse_crime_notice(evaluation);
  summary["n_registration_nodes"] = evaluation.n_registration_nodes();
  summary["registration_nodes"] = registration_nodes(evaluation);
  summary["n_increments"] = evaluation.n_increments;
  summary["n_steps"] = evaluation.n_steps();
  summary["surface_spacing_mm"] = evaluation.options.surface_spacing;
  summary["contour_spacing_mm"] = evaluation.options.contour_spacing;
  summary["line_spacing_mm"] = evaluation.options.line_spacing;
  summary["slice_pitch_mm"] = evaluation.slice_pitch;
  summary["claims"] = json::array();
  for (const ClaimVerdict &claim : assess_claims(evaluation, timings))
    summary["claims"].push_back({{"id", claim.id},
                                 {"claim", claim.claim},
                                 {"paper", claim.paper},
                                 {"criterion", claim.criterion},
                                 {"ours", claim.ours},
                                 {"verdict", claim.verdict}});
  summary["aims"] = json::array();
  for (const Aim &aim : assess_aims(evaluation))
    summary["aims"].push_back({{"id", aim.id}, {"aim", aim.aim}, {"ours", aim.ours}, {"verdict", aim.verdict}});
  summary["errors"] = errors(evaluation);
  summary["metrics_at_last_step"] = metrics_at_last_step(evaluation);
  summary["errors_by_distance"] = by_distance(evaluation);
  summary["truth_sections"] = sections(evaluation);
  summary["elements"] = elements(evaluation);
  summary["truth_motion"] = motion(evaluation);
  summary["runs"] = quality(evaluation);
  summary["penetrations"] = penetrations(evaluation);
  summary["missed_slices"] = missed(evaluation);
  summary["timing"] = timing_list(timings);
  return summary.dump(2) + "\n";
}
} // namespace pelvireg::runner
