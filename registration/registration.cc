#include "registration/registration.h"

#include "registration/implementation.h"
#include "registration/model_check.h"

#include <stdexcept>

namespace pelvireg::registration
{
namespace
{
template <class Prepared> Prepared &require_prepared(const std::unique_ptr<Prepared> &implementation, const char *call)
{
  if (!implementation)
    throw std::logic_error(std::string("registration: ") + call +
                           "() was called before prepare(); prepare a model first");
  return *implementation;
}
} // namespace

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
  return require_prepared(implementation_, "update").update(observation);
}

Equilibrium Registration::settle(const Observation &observation, const EquilibriumTolerance &tolerance)
{
  Implementation &implementation = require_prepared(implementation_, "settle");
  if (!(tolerance.motion_mm > 0) || !(tolerance.force_newton > 0) || tolerance.max_steps < 1)
    throw std::invalid_argument(
        "registration: settle() needs tolerances above 0 (mm and N) and at least one step; got " +
        std::to_string(tolerance.motion_mm) + " mm, " + std::to_string(tolerance.force_newton) + " N, " +
        std::to_string(tolerance.max_steps) + " steps");
  Equilibrium equilibrium;
  while (!equilibrium.is_reached && equilibrium.n_steps < tolerance.max_steps)
  {
    equilibrium.last_step = implementation.update(observation);
    ++equilibrium.n_steps;
    if (equilibrium.last_step.status != StepStatus::ok)
      break;
    equilibrium.is_reached = equilibrium.last_step.largest_motion <= tolerance.motion_mm &&
                             equilibrium.last_step.unbalanced_force <= tolerance.force_newton;
  }
  return equilibrium;
}

void Registration::move_points(int attachment, const Points &points)
{
  Implementation &implementation = require_prepared(implementation_, "move_points");
  const int n = static_cast<int>(implementation.n_held_nodes.size());
  if (attachment < 0 || attachment >= n)
    throw std::invalid_argument("registration: point attachment " + std::to_string(attachment) +
                                " does not exist, must lie in [0, " + std::to_string(n) + ")");
  check_points("point attachment " + std::to_string(attachment), implementation.n_held_nodes[attachment], points);
  implementation.has_moved_points = true;
  std::vector<HeldNode> &nodes = implementation.held_nodes[attachment];
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k].point = points.row(static_cast<Eigen::Index>(k)).transpose();
}

SystemSize Registration::system_size() const
{
  const Implementation &implementation = require_prepared(implementation_, "system_size");
  SystemSize size;
  for (const int body : implementation.active)
  {
    size.n_unknowns += implementation.bodies[body].n_unknowns();
    size.n_factor_values += implementation.bodies[body].n_factor_values();
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

const std::vector<PairPenetration> &Registration::penetrations() const
{
  return require_prepared(implementation_, "penetrations").penetrations;
}

const PhaseTimes &Registration::phase_times() const
{
  return require_prepared(implementation_, "phase_times").times;
}
} // namespace pelvireg::registration
