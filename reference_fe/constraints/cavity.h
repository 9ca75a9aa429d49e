// An incompressible fluid enclosed by a shell: bladder (urine), gel-filled vagina, rectum. It is kept, leaks, or is
// held at a pressure.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// Volume enclosed by faces and caps, V = 1/3 int x . (x,1 cross x,2), and the pressure q of the fluid in it (one
/// global unknown, MPa, against that at rest). Residual of the nodes -q dV/dx; the row of q decides what holds the
/// fluid:
/// - closed: V0 - V = 0, V0 the rest volume unless told otherwise (Lagrangian -q (V - V0));
/// - leak: V0 - c r(q) dt - V = 0 (mm^3): over a step the load parameter grows by dt, and c r(q) flows out a unit of it
///   (backward Euler). r(q) = q - d/2 above d = 0.01 kPa, q^2 / (2 d) between 0 and d, 0 below: nothing flows back, and
///   the slope is continuous;
/// - pressure: V_rest (q - b t) = 0 with t the load parameter at the step's end.
/// Exact tangent, symmetric but for a leaking fluid's or prescribed pressure's own row. The caps use the rim's own
/// quadratic edges, so faces and caps close exactly and neither volume nor forces depend on the origin.
class Cavity : public Term
{
public:
  /// `faces`: the walls at zeta = -1 and the cap pieces, all oriented out of the fluid.
  Cavity(std::string name, std::vector<SurfaceFace> faces, int pressure_unknown);

  std::string name() const override { return name_; }
  int n_items() const override { return static_cast<int>(faces_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  /// Fill or drain, then keep: V0 in mm^3.
  void hold_volume(double volume);
  /// Leak from the volume held now: c in mm^3 per MPa and unit of the load parameter.
  void leak(double rate);
  /// q = b t: b in MPa per unit of the load parameter.
  void prescribe_pressure(double rate);
  /// The step to be solved ends at load parameter t, not before the last accepted one.
  void begin_step(double load_parameter) { step_end_ = load_parameter; }
  /// The step was accepted with this solution: what leaked is gone.
  void accept_step(const Eigen::VectorXd &solution);

  double held_volume() const { return held_volume_; }   ///< V0, mm^3
  double volume(const Eigen::VectorXd &solution) const; ///< mm^3
  double rest_volume() const { return rest_volume_; }   ///< mm^3
  int pressure_unknown() const { return pressure_; }

private:
  enum class Control
  {
    volume,
    leak,
    pressure
  };
  struct Row
  {
    double value = 0, slope = 0; ///< mm^3, mm^3/MPa
  };
  /// What the row of q holds beside V0 - V: in q alone.
  Row fluid_row(double q) const;

  std::string name_;
  std::vector<SurfaceFace> faces_;
  int pressure_;
  std::vector<double> item_rest_volume_;
  double rest_volume_ = 0, held_volume_ = 0;
  Control control_ = Control::volume;
  double rate_ = 0;                          ///< of the leak or of the prescribed pressure
  double load_parameter_ = 0, step_end_ = 0; ///< at the last accepted state, at the end of the step to be solved
};

/// Cap pieces over a rim: a closed loop of nodes, corner and mid-side alternating, in the direction in which the
/// adjacent (outward) faces run along it. The caps run against it, hence outward.
std::vector<SurfaceFace> rim_caps(const std::vector<SurfaceNode> &rim);
} // namespace pelvireg::reference_fe
