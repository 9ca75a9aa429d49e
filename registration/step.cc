#include "registration/implementation.h"
#include "registration/model_check.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace pelvireg::registration
{
namespace
{
/// Milliseconds since the last call, for the phases of a step.
class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return elapsed;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Triangles wall_triangles(const Body &body)
{
  Triangles walls(body.outer_triangles.rows(), 3);
  Eigen::Index n_walls = 0;
  for (Eigen::Index t = 0; t < body.outer_triangles.rows(); ++t)
    if (body.is_wall[t])
      walls.row(n_walls++) = body.outer_triangles.row(t);
  walls.conservativeResize(n_walls, 3);
  return walls;
}

/// The body with what holds it in this condition: without anatomical constraints an organ floats.
Body held_body(Body body, bool use_attachments)
{
  if (is_organ(body) && !use_attachments)
    body.fixed_nodes.clear();
  return body;
}

/// The body as a mutation leaves it.
Body mutated_body(Body body, int index, const Mutation &mutation)
{
  if (index == mutation.wrong_body)
    body.youngs_modulus *= mutation.wrong_factor;
  return body;
}

/// The model's box, three times as large.
Eigen::AlignedBox3d neighbourhood_of(const Model &model)
{
  Eigen::AlignedBox3d box;
  for (const Body &body : model.bodies)
    for (Eigen::Index node = 0; node < body.rest_positions.rows(); ++node)
      box.extend(body.rest_positions.row(node).transpose());
  const double reach = box.diagonal().norm();
  return {box.min().array() - reach, box.max().array() + reach};
}

/// True when the surface has points on both sides of the plane.
bool plane_cuts(const Triangles &surface, const Points &positions, const Observation &observation)
{
  bool has_left = false, has_right = false;
  for (const int node : surface.reshaped())
  {
    const double side = (positions.row(node).transpose() - observation.plane_origin).dot(observation.plane_normal);
    has_left = has_left || side >= 0;
    has_right = has_right || side <= 0;
  }
  return has_left && has_right;
}
} // namespace

Registration::Implementation::Implementation(const Model &model, const Options &opts)
    : options(opts), held_nodes(model.point_attachments.size()), threads(opts.n_threads),
      neighbourhood(neighbourhood_of(model)), succeeded(model.bodies.size(), 1)
{
  for (const PointAttachment &attachment : model.point_attachments)
    n_held_nodes.push_back(attachment.nodes.size());
  for (const Body &body : model.bodies)
  {
    bodies.emplace_back(
        mutated_body(held_body(body, options.use_attachments), static_cast<int>(bodies.size()), options.mutation),
        options.time_step, !options.mutation.stale_rotations);
    trees.emplace_back(wall_triangles(body), body.rest_positions);
    outer_surfaces.push_back(body.outer_triangles);
    nodal_forces.push_back(Points::Zero(body.rest_positions.rows(), 3));
    slip_origins.push_back(body.rest_positions);
    if (is_organ(body) || options.use_attachments)
      active.push_back(static_cast<int>(bodies.size()) - 1);
  }
  std::stable_sort(active.begin(), active.end(),
                   [&](int a, int b) { return bodies[a].n_unknowns() > bodies[b].n_unknowns(); });
  for (const Attachment &attachment : model.attachments)
  {
    if (!options.use_attachments)
      break;
    if (&attachment - model.attachments.data() == options.mutation.dropped_attachment)
      continue;
    const std::vector<AttachedNode> bound =
        bind_attachment(attachment, model.bodies, trees[attachment.body_b], options.attachment_compliance);
    attached_nodes.insert(attached_nodes.end(), bound.begin(), bound.end());
  }
  if (options.use_attachments)
    for (std::size_t k = 0; k < model.point_attachments.size(); ++k)
      held_nodes[k] = hold_nodes(model.point_attachments[k], options.attachment_compliance);
  if (options.use_contact)
    for (const ContactPair &pair : model.contact_pairs)
      add_pair(model, pair);
  reserve_memory();
  detect_contacts();
}

StepSummary Registration::Implementation::update(const Observation &observation)
{
  StepSummary summary;
  times = {};
  Stopwatch watch;
  const auto fail = [&](StepStatus status)
  {
    summary.status = status;
    return summary;
  };

  if (const StepStatus status = check(observation); status != StepStatus::ok)
    return fail(status);
  follow_image(observation);
  match_outlines(observation);
  linearise_constraints(summary);
  times.match = watch.lap();
  const bool has_held_nodes =
      std::any_of(held_nodes.begin(), held_nodes.end(), [](const auto &nodes) { return !nodes.empty(); });
  if (summary.accepted_control_points == 0 && !has_held_nodes)
    return fail(StepStatus::no_control_points);

  threads.run(active, [this](int body) { bodies[body].assemble(); });
  times.assemble = watch.lap();
  if (!factorise_bodies())
    return fail(StepStatus::factorisation_failed);
  times.factorise = watch.lap();
  threads.run(active, [this](int body) { bodies[body].predict_free_motion(); });
  times.free_motion = watch.lap();
  threads.run(active,
              [this](int body)
              {
                bodies[body].gather_rows(rows, body);
                bodies[body].compute_compliance();
              });
  times.compliance = watch.lap();
  if (!solve_constraints(summary))
    return fail(StepStatus::factorisation_failed);
  times.solve = watch.lap();
  if (const StepStatus status = correct_bodies(summary); status != StepStatus::ok)
    return fail(status);
  times.correct = watch.lap();

  measure_forces(observation, summary);
  measure_residuals(observation, summary);
  times.summarise = watch.lap();
  remember_contact_forces(summary);
  detect_contacts(); // what this step leaves is what the next one starts from
  measure_contact(summary);
  times.contact = watch.lap();
  return summary;
}

StepStatus Registration::Implementation::check(const Observation &observation) const
{
  bool is_finite = observation.plane_origin.allFinite() && observation.plane_normal.allFinite();
  bool is_valid = std::abs(observation.plane_normal.norm() - 1) <= 1e-6;
  for (const OutlineObservation &outline : observation.outlines)
  {
    const bool is_known = outline.body >= 0 && outline.body < static_cast<int>(bodies.size());
    is_valid = is_valid && is_known && outline.points.rows() == outline.normals.rows() &&
               trees[is_known ? outline.body : 0].triangles().rows() > 0;
    is_finite = is_finite && outline.points.allFinite() && outline.normals.allFinite();
  }
  if (!is_finite)
    return StepStatus::not_finite;
  return is_valid ? StepStatus::ok : StepStatus::invalid_observation;
}

void Registration::Implementation::match_outlines(const Observation &observation)
{
  matches.clear();
  for (const OutlineObservation &outline : observation.outlines)
  {
    const Points &positions = bodies[outline.body].positions();
    TriangleTree &tree = trees[outline.body];
    tree.refit(positions);
    const bool is_cut = plane_cuts(tree.triangles(), positions, observation);
    for (Eigen::Index k = 0; k < outline.points.rows(); ++k)
    {
      Match &match = matches.emplace_back();
      match.body = outline.body;
      if (is_cut)
        match.sliding = match_control_point(tree, positions, outline.points.row(k).transpose(),
                                            outline.normals.row(k).transpose(), observation.plane_normal, options);
    }
  }
}

void Registration::Implementation::linearise_constraints(StepSummary &summary)
{
  rows.clear();
  summary.offered_control_points = static_cast<int>(matches.size());
  for (const Match &match : matches)
    if (match.sliding.is_accepted)
      add_sliding_row(match.sliding, match.body, options.sliding_compliance, rows);
  summary.accepted_control_points = rows.size();
  for (const AttachedNode &node : attached_nodes)
    add_attachment_rows(node, bodies[node.body_a].positions(), bodies[node.body_b].positions(), rows);
  for (const std::vector<HeldNode> &nodes : held_nodes)
    for (const HeldNode &node : nodes)
      add_held_rows(node, bodies[node.body].positions(), rows);
  n_bilateral_rows = rows.size();
  add_contacts(summary);
}

bool Registration::Implementation::factorise_bodies()
{
  threads.run(active, [this](int body) { succeeded[body] = bodies[body].factorise(); });
  return std::all_of(active.begin(), active.end(), [this](int body) { return succeeded[body] != 0; });
}

bool Registration::Implementation::solve_constraints(StepSummary &summary)
{
  constraint_solver.reset(rows.size(), n_bilateral_rows, has_friction() ? 3 : 1, options.friction_coefficient);
  std::vector<double> &gaps = remaining_gaps;
  gaps.resize(rows.size());
  for (int row = 0; row < rows.size(); ++row)
    gaps[row] = rows.gap(row);
  for (std::size_t body = 0; body < bodies.size(); ++body) // in body order: sums do not depend on the threads
  {
    const std::vector<int> &touching = bodies[body].touching_rows();
    constraint_solver.add_compliance(touching, bodies[body].compliance());
    for (std::size_t k = 0; k < touching.size(); ++k)
      gaps[touching[k]] -= bodies[body].free_gap_change(static_cast<int>(k));
  }
  for (int row = 0; row < rows.size(); ++row)
    constraint_solver.set_row(row, gaps[row], rows.compliance(row));
  guess_contact_forces();
  const bool is_solved = constraint_solver.solve({options.tolerance_mm, options.tolerance_newton, options.max_sweeps});
  summary.sweeps = constraint_solver.sweeps();
  summary.contact_motion_residual = constraint_solver.contact_residual().motion;
  summary.contact_force_residual = constraint_solver.contact_residual().force;
  summary.complementarity = constraint_solver.contact_residual().complementarity;
  summary.cone_violation = constraint_solver.contact_residual().cone_violation;
  return is_solved;
}

StepStatus Registration::Implementation::correct_bodies(StepSummary &summary)
{
  threads.run(active, [this](int body) { succeeded[body] = bodies[body].correct(constraint_solver.multipliers()); });
  if (!std::all_of(active.begin(), active.end(), [this](int body) { return succeeded[body] != 0; }))
    return StepStatus::not_finite;
  for (const int body : active)
    for (const auto position : bodies[body].corrected_positions().rowwise())
      if (!neighbourhood.contains(position.transpose()))
        return StepStatus::diverged;
  for (const int body : active)
  {
    summary.largest_motion =
        std::max(summary.largest_motion,
                 (bodies[body].corrected_positions() - bodies[body].positions()).rowwise().norm().maxCoeff());
    bodies[body].accept();
  }
  return StepStatus::ok;
}
} // namespace pelvireg::registration
