// What the abdominal pressure and the fluids did along the path of the solution.
#pragma once

#include "reference_fe/constraints/cavity.h"
#include "reference_fe/constraints/follower_pressure.h"

#include <memory>
#include <vector>

namespace pelvireg::reference_fe
{
/// Integrals over the path from rest through every accepted state. Neither is a function of the state: a follower
/// pressure on open surfaces has no potential, and a leaking fluid dissipates.
///
/// Between two states, positions, pressures and volumes run along the parabola in the distance moved through these two
/// and the state before them; four Gauss points integrate p N . v over it exactly (degree 7). The path between the
/// states is not known better: what is left is of third order in the step. The same integral over straight lines is
/// kept beside it (second order); the sum of the differences is stated as a bound.
class PathWork
{
public:
  PathWork(std::shared_ptr<const FollowerPressure> load, std::vector<std::shared_ptr<Cavity>> cavities);

  /// The next converged state; the first is rest, all unknowns zero.
  void advance(const Eigen::VectorXd &solution);

  double external_work() const { return external_; }            ///< N mm, of the pressure on the pelvis
  double uncertainty() const { return uncertainty_; }           ///< N mm, of work and cavity work together
  const Eigen::VectorXd &cavity_work() const { return fluid_; } ///< N mm, given to each fluid: minus int q dV

private:
  /// One converged state.
  struct State
  {
    double at = 0;                       ///< distance moved from rest, mm (root of the sum over face nodes)
    std::vector<Eigen::Matrix3Xd> faces; ///< positions of the nodes of each loaded face
    double pressure = 0;                 ///< MPa
    Eigen::VectorXd fluid_pressures, fluid_volumes;
  };
  State state_at(const Eigen::VectorXd &solution) const;
  /// Works of the pressure and of each cavity from the last state to `next`, along a line or a parabola.
  Eigen::VectorXd works_to(const State &next, bool is_straight) const;

  std::shared_ptr<const FollowerPressure> load_;
  std::vector<std::shared_ptr<Cavity>> cavities_;
  std::vector<State> last_; ///< the last one or two states, older first
  double external_ = 0, uncertainty_ = 0;
  Eigen::VectorXd fluid_;
};
} // namespace pelvireg::reference_fe
