#include "validation/report/view_data.h"

#include "validation/metrics/surface_distance.h"
#include "validation/runner/conditions.h"
#include "validation/runner/outer_surface.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>

namespace pelvireg::report
{
namespace
{
using dataset::organ_names;
using dataset::Points;
using json = nlohmann::ordered_json;

constexpr double quantum = 0.02;       ///< mm
constexpr double bar_quantum = 0.05;   ///< mm: bars are drawn, not measured
constexpr double error_quantum = 0.04; ///< mm: 10.2 mm at most

void add_surface(Payload &payload, const std::string &name, const MovingSurface &organ)
{
  std::vector<std::int32_t> wall, caps;
  for (Eigen::Index t = 0; t < organ.rest.triangles.rows(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      (metrics::is_scored(organ.rest.region[t]) ? wall : caps).push_back(organ.rest.triangles(t, corner));
  payload.add(name, pack_positions(organ.frames, quantum));
  payload.add(name + "/wall", pack_indices(wall));
  payload.add(name + "/caps", pack_indices(caps));
}

json node_counts(const std::vector<MovingSurface> &organs)
{
  json counts = json::array();
  for (const MovingSurface &organ : organs)
    counts.push_back(organ.rest.points.rows());
  return counts;
}

metrics::SurfaceTree tree_of(const MovingSurface &organ, std::size_t frame)
{
  return {organ.at(frame), organ.rest.triangles, organ.rest.region};
}

/// Distances between an organ of the truth and of an estimate, in both directions, at each step.
void add_errors(Payload &payload, const std::string &place, const MovingSurface &truth, const MovingSurface &estimate,
                int steps_per_increment)
{
  const std::size_t n_steps = (truth.frames.size() - 1) * static_cast<std::size_t>(steps_per_increment);
  std::vector<std::vector<double>> forth, back;
  std::optional<metrics::SurfaceTree> truth_tree;
  for (std::size_t step = 1; step <= n_steps; ++step)
  {
    const std::size_t increment = (step - 1) / static_cast<std::size_t>(steps_per_increment) + 1;
    if ((step - 1) % static_cast<std::size_t>(steps_per_increment) == 0)
      truth_tree.emplace(tree_of(truth, increment));
    forth.push_back(metrics::surface_distances(truth.at(increment), tree_of(estimate, step)));
    back.push_back(metrics::surface_distances(estimate.at(step), *truth_tree));
  }
  payload.add("error/" + place, pack_values(forth, error_quantum));
  payload.add("error_back/" + place, pack_values(back, error_quantum));
}

json add_bars(Payload &payload, const dataset::Truth &truth)
{
  if (truth.trusses.empty())
    return 0;
  const auto n = static_cast<Eigen::Index>(truth.trusses.size());
  std::vector<Points> frames(truth.trusses.front().positions.size() + 1, Points(2 * n, 3));
  for (Eigen::Index bar = 0; bar < n; ++bar)
  {
    const dataset::TruthTruss &truss = truth.trusses[static_cast<std::size_t>(bar)];
    frames[0].middleRows(2 * bar, 2) = truss.rest;
    for (std::size_t i = 0; i < truss.positions.size(); ++i)
      frames[i + 1].middleRows(2 * bar, 2) = truss.positions[i];
  }
  payload.add("bars", pack_positions(frames, bar_quantum));
  return n;
}

/// Nodes of an organ's outer surface next to the points that an attachment holds, at rest: they move with the surface.
std::set<Eigen::Index> held_nodes(const dataset::RegistrationModel &model,
                                  const dataset::RegistrationAttachment &attachment, const Points &surface)
{
  const Points &body = model.bodies[static_cast<std::size_t>(runner::body_index(model, attachment.body_a))].points;
  std::set<Eigen::Index> nodes;
  for (const std::int32_t node : attachment.nodes_a)
  {
    Eigen::Index closest = 0;
    (surface.rowwise() - body.row(node)).rowwise().squaredNorm().minCoeff(&closest);
    nodes.insert(closest);
  }
  return nodes;
}

/// What holds the organs in a condition, one list an organ.
json attachments_json(const dataset::Anatomy &anatomy, const ConditionSurfaces &condition)
{
  std::vector<std::set<Eigen::Index>> held(condition.organs.size());
  if (!condition.constraints.empty() && runner::options_of(condition.constraints, anatomy).use_attachments)
  {
    const dataset::RegistrationModel model = runner::model_of(condition.constraints, anatomy.registration);
    for (const dataset::RegistrationAttachment &attachment : model.attachments)
      for (std::size_t organ = 0; organ < held.size(); ++organ)
        if (attachment.body_b == organ_names[organ])
          held[organ].merge(held_nodes(model, attachment, condition.organs[organ].rest.points));
  }
  return held;
}

json control_points_json(const dataset::Observations *observations)
{
  json frames = json::array();
  if (!observations)
    return frames;
  const auto add = [&](const dataset::DynamicFrame &frame)
  {
    json coordinates = json::array();
    for (const Points &points : frame.control_points)
      for (Eigen::Index i = 0; i < points.size(); ++i)
        coordinates.push_back(std::round(points.data()[i] / quantum) * quantum);
    frames.push_back(coordinates);
  };
  add(observations->rest);
  for (const dataset::DynamicFrame &frame : observations->frames)
    add(frame);
  return frames;
}

json vector_json(const Eigen::Vector3d &v)
{
  return {v.x(), v.y(), v.z()};
}
} // namespace

json view_data(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
               const std::vector<ConditionSurfaces> &conditions, Payload &payload)
{
  const int n_organs = static_cast<int>(truth.size());
  for (int o = 0; o < n_organs; ++o)
    add_surface(payload, fmt::format("truth/{}", o), truth[static_cast<std::size_t>(o)]);
  for (std::size_t c = 0; c < conditions.size(); ++c)
    for (int o = 0; o < n_organs; ++o)
    {
      const std::string place = fmt::format("{}/{}", c, o);
      const MovingSurface &estimate = conditions[c].organs[static_cast<std::size_t>(o)];
      add_surface(payload, "estimate/" + place, estimate);
      add_errors(payload, place, truth[static_cast<std::size_t>(o)], estimate, inputs.evaluation.steps_per_increment);
    }
  json view = {{"quantum_mm", quantum},
               {"bar_quantum_mm", bar_quantum},
               {"error_quantum_mm", error_quantum},
               {"truth_nodes", node_counts(truth)}};
  view["estimate_nodes"] = json::array();
  for (const ConditionSurfaces &condition : conditions)
    view["estimate_nodes"].push_back(node_counts(condition.organs));
  view["plane"] = {{"origin", vector_json(inputs.anatomy.dyn_plane.origin)},
                   {"normal", vector_json(inputs.anatomy.dyn_plane.normal)}};
  view["bars"] = add_bars(payload, inputs.truth);
  view["attachments"] = json::array();
  for (const ConditionSurfaces &condition : conditions)
    view["attachments"].push_back(attachments_json(inputs.anatomy, condition));
  view["control_points"] = control_points_json(inputs.observations);
  return view;
}
} // namespace pelvireg::report
