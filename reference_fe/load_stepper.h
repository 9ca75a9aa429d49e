// The quasi-static loop: how the pelvis is moved from increment to increment.
#pragma once

#include "reference_fe/newton_solver.h"
#include "reference_fe/path_work.h"
#include "reference_fe/pelvis_model.h"

#include <functional>
#include <string>

namespace pelvireg::reference_fe
{
struct LoadStepperOptions
{
  double increment = 1;             ///< mm of displacement a unit of the load parameter, by which cavities leak or fill
  double residual_tolerance = 1e-6; ///< N, largest scaled free residual of a converged state
  double start_pressure = 2e-6;     ///< MPa, first prescribed pressure
  double start_displacement = 0.02; ///< fraction of the target from which on the displacement is prescribed
  double first_motion = 0.8;        ///< mm, largest motion of a surface point that the first steps aim at
  double motion = 1.4;              ///< mm, to which it grows while steps are easy
  double largest_motion = 2.8;      ///< mm, a step that moved any surface point farther is thrown away and cut
  int easy_factorisations = 3;      ///< a step with no more of them lets the next one be longer,
  double reached_motion = 0.5;      ///< if it was as long as this share of the motion aimed at (equal parts are), or
  double settled_motion = 0.8;      ///< this, in start(): its steps are short, and so easy, for other reasons too
  double least_motion = 1e-3;       ///< mm, steps that aim at less: the stepper gives up
  double close_residual = 0.1;      ///< N, a failed solution below it is not begun anew
  int max_iterations = 12;          ///< of Newton's method, a solution
  int max_halvings = 2;             ///< a solution that needs shorter steps is lost: a shorter load step is cheaper
  double chord_increment = 0.01;    ///< NewtonOptions::chord_increment
  double search_increment = 0.12;   ///< from Newton steps no longer than this on, pairs in contact are searched anew
  int max_contact_searches = 6;     ///< in a solution, and repetitions of it, until the pairs settle
  std::function<void(const std::string &)> log = {}; ///< one line a step and a Newton iteration; may be empty
};

/// What it took to reach a target.
struct StepEffort
{
  double residual = 0; ///< N, of the accepted state
  int newton_iterations = 0;
  int factorisations = 0; ///< the iterations that were no chords
  int cuts = 0;
  int unsettled_steps = 0; ///< accepted although contact pairs still changed after max_contact_searches
};

/// Quasi-static path with an unknown load factor: each step prescribes the mean vaginal in-plane displacement and finds
/// positions, cavity pressures and the abdominal pressure together. At rest that displacement has no derivative, and
/// organs that hang loosely settle before the vagina moves: the path begins with prescribed pressures.
/// Steps are as long as lets no surface point move farther than contact can follow.
/// The load parameter is the displacement in increments: exactly where a target is reached, as predicted at the steps
/// between, and it stands still while the path goes back and until start() is over. Per increment it grows by one.
class LoadStepper
{
public:
  LoadStepper(PelvisModel &model, const LoadStepperOptions &options);

  /// Leave the rest state by prescribed pressures until the mean displacement reaches start_displacement of `target`
  /// (mm). Throws ComputationError as advance_to().
  StepEffort start(double target);
  /// Move on to a mean displacement (mm), in sub-steps where needed. Throws ComputationError with displacement,
  /// residual and likely cause when the least step does not converge.
  StepEffort advance_to(double target);

  const Eigen::VectorXd &solution() const { return current_.solution; }
  double displacement() const { return current_.displacement; } ///< mm
  const PathWork &work() const { return work_; }                ///< from rest to solution()

private:
  struct State
  {
    Eigen::VectorXd solution;
    double displacement = 0;   ///< mm
    double pressure = 0;       ///< MPa
    double load_parameter = 0; ///< increments
  };
  /// current + ratio (current - previous).
  Eigen::VectorXd predicted(double ratio) const;
  /// One step along the path from a predictor: equilibrium, acceptance. False: cut. A step past `largest_displacement`
  /// (mm) is thrown away too.
  bool try_step(Eigen::VectorXd trial, double largest_displacement, StepEffort &effort);
  /// The same under a prescribed pressure, MPa. The predictor has it already: its row counts MPa as N, so that a low
  /// pressure not yet applied would pass for equilibrium, and to apply it would seem to raise the residual.
  bool try_pressure(double ratio, double pressure, StepEffort &effort);
  void control_step(bool lands, double target, double ratio);
  /// Tell the cavities that the step to be solved is to end at this displacement, mm.
  void begin_step(double displacement);
  /// Equilibrium with settled contact pairs, from `trial`; false when Newton's method fails.
  bool solve(Eigen::VectorXd &trial, StepEffort &effort);
  /// Newton's method with the shells' mixed integration points, which take a third of the iterations; where they do
  /// not converge, with the exact tangent.
  void solve_equilibrium(Eigen::VectorXd &trial, StepEffort &effort);
  void accept(Eigen::VectorXd trial);
  /// Largest distance that a surface point moves between two solutions, mm.
  double motion_between(const Eigen::VectorXd &from, const Eigen::VectorXd &to) const;
  void cut(StepEffort &effort);

  PelvisModel &model_;
  LoadStepperOptions options_;
  State previous_, current_;
  double step_end_ = 0; ///< load parameter at the end of the step to be solved
  double motion_;       ///< mm, what the steps aim at now, options_.motion at most
  PathWork work_;
  NewtonResult last_result_; ///< of the last solution, for the message when it failed
};
} // namespace pelvireg::reference_fe
