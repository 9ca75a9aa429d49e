// An incompressible fluid enclosed by a shell: bladder (urine), gel-filled vagina, rectum.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// Volume enclosed by faces and caps, V = 1/3 int x . (x,1 cross x,2), held at V0, its rest value unless told
/// otherwise, by the pressure q (one global unknown, MPa): Lagrangian -q (V - V0). Residual of the nodes -q dV/dx, row
/// of q: -(V - V0) in mm^3. Exact symmetric tangent. The caps use the rim's own quadratic edges, so faces and caps
/// close exactly and neither volume nor forces depend on the origin.
class Cavity : public Term
{
public:
  /// `faces`: the walls at zeta = -1 and the cap pieces, all oriented out of the fluid.
  Cavity(std::string name, std::vector<SurfaceFace> faces, int pressure_unknown);

  std::string name() const override { return name_; }
  int n_items() const override { return static_cast<int>(faces_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  /// Fill or drain: V0 in mm^3.
  void hold_volume(double volume) { held_volume_ = volume; }
  double held_volume() const { return held_volume_; }   ///< V0, mm^3
  double volume(const Eigen::VectorXd &solution) const; ///< mm^3
  double rest_volume() const { return rest_volume_; }   ///< mm^3
  int pressure_unknown() const { return pressure_; }

private:
  std::string name_;
  std::vector<SurfaceFace> faces_;
  int pressure_;
  std::vector<double> item_rest_volume_;
  double rest_volume_ = 0, held_volume_ = 0;
};

/// Cap pieces over a rim: a closed loop of nodes, corner and mid-side alternating, in the direction in which the
/// adjacent (outward) faces run along it. The caps run against it, hence outward.
std::vector<SurfaceFace> rim_caps(const std::vector<SurfaceNode> &rim);
} // namespace pelvireg::reference_fe
