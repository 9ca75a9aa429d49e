#include "registration/registration.h"

#include "registration/constraints/attachment.h"
#include "registration/constraints/point_attachment.h"
#include "registration/constraints/sliding.h"
#include "registration/model_check.h"
#include "registration/solver/body_solver.h"
#include "registration/solver/body_threads.h"
#include "registration/solver/constraint_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace pelvireg::registration
{
std::vector<std::string> Options::violations() const
{
  std::vector<std::string> problems;
  const auto demand = [&](bool holds, const std::string &name, double got, const std::string &allowed)
  {
    if (!holds)
      problems.push_back("registration option " + name + " is " + std::to_string(got) + ", must be " + allowed);
  };
  const auto is_compliance = [](double c) { return c >= 0 && std::isfinite(c); };
  demand(time_step > 0 && std::isfinite(time_step), "time_step", time_step, "positive and finite (s)");
  demand(max_match_distance > 0 && std::isfinite(max_match_distance), "max_match_distance", max_match_distance,
         "positive and finite (mm)");
  demand(min_normal_agreement >= -1 && min_normal_agreement <= 1, "min_normal_agreement", min_normal_agreement,
         "a cosine in [-1, 1]");
  demand(is_compliance(sliding_compliance), "sliding_compliance", sliding_compliance, "finite and not negative (mm/N)");
  demand(is_compliance(attachment_compliance), "attachment_compliance", attachment_compliance,
         "finite and not negative (mm/N)");
  demand(max_sweeps >= 1, "max_sweeps", max_sweeps, "at least 1");
  demand(tolerance_mm > 0 && std::isfinite(tolerance_mm), "tolerance_mm", tolerance_mm, "positive and finite (mm)");
  demand(n_threads >= 1, "n_threads", n_threads, "at least 1");
  return problems;
}

std::string to_string(StepStatus status)
{
  switch (status)
  {
  case StepStatus::ok:
    return "The step succeeded.";
  case StepStatus::no_control_points:
    return "No control point was offered or accepted, so nothing drives the step; positions are unchanged.";
  case StepStatus::not_finite:
    return "The observation or the solution is not finite; positions are unchanged.";
  case StepStatus::factorisation_failed:
    return "A matrix of the step is not positive definite; positions are unchanged.";
  case StepStatus::invalid_observation:
    return "The observation names a body that cannot be matched, has unequal numbers of points and normals, or its "
           "plane "
           "normal is not unit; positions are unchanged.";
  }
  return "unknown status";
}

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

struct Registration::Implementation
{
  Implementation(const Model &model, const Options &options);

  StepSummary update(const Observation &observation);

  StepStatus check(const Observation &observation) const;
  void match_outlines(const Observation &observation);
  void linearise_constraints(StepSummary &summary);
  bool factorise_bodies();
  bool solve_constraints(StepSummary &summary);
  bool correct_bodies();
  void measure_forces(const Observation &observation, StepSummary &summary);
  void measure_residuals(const Observation &observation, StepSummary &summary);

  struct Match
  {
    int body = 0;
    SlidingMatch sliding;
  };

  Options options;
  std::vector<BodySolver> bodies;
  std::vector<TriangleTree> trees; ///< wall triangles, one a body
  std::vector<int> active;         ///< bodies that take part, the largest first
  std::vector<AttachedNode> attached_nodes;
  std::vector<std::size_t> n_held_nodes; ///< of every point attachment, used or not
  std::vector<std::vector<HeldNode>> held_nodes; ///< of every point attachment; empty ones when they are not used
  BodyThreads threads;

  std::vector<Match> matches;
  ConstraintRows rows;
  ConstraintSolver constraint_solver;
  std::vector<double> remaining_gaps; ///< after the free motion, mm, one a row
  std::vector<char> succeeded;        ///< a flag a body
  std::vector<Points> nodal_forces;
  PhaseTimes times;
};

Registration::Implementation::Implementation(const Model &model, const Options &opts)
    : options(opts), held_nodes(model.point_attachments.size()), threads(opts.n_threads),
      succeeded(model.bodies.size(), 1)
{
  for (const PointAttachment &attachment : model.point_attachments)
    n_held_nodes.push_back(attachment.nodes.size());
  for (const Body &body : model.bodies)
  {
    bodies.emplace_back(held_body(body, options.use_attachments), options.time_step);
    trees.emplace_back(wall_triangles(body), body.rest_positions);
    nodal_forces.push_back(Points::Zero(body.rest_positions.rows(), 3));
    if (is_organ(body) || options.use_attachments)
      active.push_back(static_cast<int>(bodies.size()) - 1);
  }
  std::stable_sort(active.begin(), active.end(),
                   [&](int a, int b) { return bodies[a].n_unknowns() > bodies[b].n_unknowns(); });
  if (!options.use_attachments)
    return;
  for (const Attachment &attachment : model.attachments)
  {
    const std::vector<AttachedNode> bound =
        bind_attachment(attachment, model.bodies, trees[attachment.body_b], options.attachment_compliance);
    attached_nodes.insert(attached_nodes.end(), bound.begin(), bound.end());
  }
  for (std::size_t k = 0; k < model.point_attachments.size(); ++k)
    held_nodes[k] = hold_nodes(model.point_attachments[k], options.attachment_compliance);
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
  if (!correct_bodies())
    return fail(StepStatus::not_finite);
  times.correct = watch.lap();

  measure_forces(observation, summary);
  measure_residuals(observation, summary);
  times.summarise = watch.lap();
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
    add_attachment_rows(node, attachment_gap(node, bodies[node.body_a].positions(), bodies[node.body_b].positions()),
                        rows);
  for (const std::vector<HeldNode> &nodes : held_nodes)
    for (const HeldNode &node : nodes)
      add_held_rows(node, bodies[node.body].positions(), rows);
}

bool Registration::Implementation::factorise_bodies()
{
  threads.run(active, [this](int body) { succeeded[body] = bodies[body].factorise(); });
  return std::all_of(active.begin(), active.end(), [this](int body) { return succeeded[body] != 0; });
}

bool Registration::Implementation::solve_constraints(StepSummary &summary)
{
  constraint_solver.reset(rows.size());
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
  const bool is_solved = constraint_solver.solve(options.tolerance_mm, options.max_sweeps);
  summary.sweeps = constraint_solver.sweeps();
  return is_solved;
}

bool Registration::Implementation::correct_bodies()
{
  threads.run(active, [this](int body) { succeeded[body] = bodies[body].correct(constraint_solver.multipliers()); });
  if (!std::all_of(active.begin(), active.end(), [this](int body) { return succeeded[body] != 0; }))
    return false;
  for (const int body : active)
    bodies[body].accept();
  return true;
}

void Registration::Implementation::measure_forces(const Observation &observation, StepSummary &summary)
{
  for (Points &forces : nodal_forces)
    forces.setZero();
  for (int row = 0; row < rows.size(); ++row)
    if (rows.kind(row) == RowKind::sliding)
      for (const RowEntry *entry = rows.begin(row); entry != rows.end(row); ++entry)
        nodal_forces[entry->body].row(entry->node) +=
            constraint_solver.multipliers()[row] * entry->jacobian.transpose();
  for (const Points &forces : nodal_forces)
    for (Eigen::Index node = 0; node < forces.rows(); ++node)
    {
      const Eigen::Vector3d force = forces.row(node).transpose();
      const double across = force.dot(observation.plane_normal);
      summary.out_of_plane_force = std::max(summary.out_of_plane_force, std::abs(across));
      summary.in_plane_force = std::max(summary.in_plane_force, (force - across * observation.plane_normal).norm());
    }
}

void Registration::Implementation::measure_residuals(const Observation &observation, StepSummary &summary)
{
  match_outlines(observation);
  int n_accepted = 0;
  double sum = 0;
  for (const Match &match : matches)
    if (match.sliding.is_accepted)
    {
      ++n_accepted;
      sum += std::abs(match.sliding.gap);
      summary.max_in_plane_residual = std::max(summary.max_in_plane_residual, std::abs(match.sliding.gap));
    }
  summary.mean_in_plane_residual = n_accepted > 0 ? sum / n_accepted : 0;
  for (const AttachedNode &node : attached_nodes)
    summary.attachment_residual =
        std::max(summary.attachment_residual,
                 attachment_gap(node, bodies[node.body_a].positions(), bodies[node.body_b].positions()).norm());
  for (const std::vector<HeldNode> &nodes : held_nodes)
    for (const HeldNode &node : nodes)
      summary.attachment_residual =
          std::max(summary.attachment_residual, held_gap(node, bodies[node.body].positions()).norm());
}

Registration::Registration() = default;
Registration::~Registration() = default;
Registration::Registration(Registration &&) noexcept = default;
Registration &Registration::operator=(Registration &&) noexcept = default;

void Registration::prepare(const Model &model, const Options &options)
{
  if (const std::vector<std::string> problems = options.violations(); !problems.empty())
    throw std::invalid_argument(problems.front());
  check_model(model);
  implementation_ = std::make_unique<Implementation>(model, options);
}

StepSummary Registration::update(const Observation &observation)
{
  if (!implementation_)
    throw std::logic_error("registration: update() was called before prepare(); prepare a model first");
  return implementation_->update(observation);
}

void Registration::move_points(int attachment, const Points &points)
{
  if (!implementation_)
    throw std::logic_error("registration: move_points() was called before prepare(); prepare a model first");
  const int n = static_cast<int>(implementation_->n_held_nodes.size());
  if (attachment < 0 || attachment >= n)
    throw std::invalid_argument("registration: point attachment " + std::to_string(attachment) +
                                " does not exist, must lie in [0, " + std::to_string(n) + ")");
  check_points("point attachment " + std::to_string(attachment), implementation_->n_held_nodes[attachment], points);
  std::vector<HeldNode> &nodes = implementation_->held_nodes[attachment];
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k].point = points.row(static_cast<Eigen::Index>(k)).transpose();
}

SystemSize Registration::system_size() const
{
  if (!implementation_)
    throw std::logic_error("registration: system_size() was called before prepare(); prepare a model first");
  SystemSize size;
  for (const int body : implementation_->active)
  {
    size.n_unknowns += implementation_->bodies[body].n_unknowns();
    size.n_factor_values += implementation_->bodies[body].n_factor_values();
  }
  return size;
}

const Points &Registration::positions(int body) const
{
  if (!implementation_ || body < 0 || body >= static_cast<int>(implementation_->bodies.size()))
    throw std::logic_error("registration: positions(" + std::to_string(body) +
                           ") names no body of a prepared model; prepare first and index from 0");
  return implementation_->bodies[body].positions();
}

const PhaseTimes &Registration::phase_times() const
{
  if (!implementation_)
    throw std::logic_error("registration: phase_times() was called before prepare(); prepare a model first");
  return implementation_->times;
}
} // namespace pelvireg::registration
