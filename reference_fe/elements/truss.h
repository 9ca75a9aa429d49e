// Bars: ligaments and fasciae.
#pragma once

#include "reference_fe/elements/surface_node.h"
#include "reference_fe/term.h"
#include "synthetic/dataset/anatomy.h"

#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// One straight bar between two nodes, or between a node and a fixed point.
struct Bar
{
  std::string group;                                   ///< "cardinal_left", …
  std::vector<SurfaceNode> nodes;                      ///< one or two, side 0
  Eigen::Vector3d fixed_end = Eigen::Vector3d::Zero(); ///< mm; used when there is one node
  double area = 0;                                     ///< rest section, mm^2
  dataset::YeohMaterial material;                      ///< kappa is not used: the bar keeps its volume
  bool tension_only = false;                           ///< slack in compression: see tension_only_response()
};

/// Uniaxial response of a bar at stretch lambda: energy per volume and its first two derivatives, MPa.
struct UniaxialResponse
{
  double energy = 0, stress = 0, modulus = 0;
};

/// Incompressible Yeoh law, I1 = lambda^2 + 2 / lambda: nominal stress 2 (lambda - lambda^-2) sum_i i C_i0 (I1 -
/// 3)^(i-1), initial modulus 6 C10. The same law in compression, as Abaqus' T3D2: fasciae and the urethra are pressed
/// as well as pulled, and an organ that rests on slack bars alone would be a mechanism.
UniaxialResponse uniaxial_response(const dataset::YeohMaterial &material, double lambda);

/// The same bar as a cord: it carries what its law gives at the stretch 1 + phi(lambda - 1), with phi = 0 in
/// compression and phi(e) = e - tension_only_width / 2 from e = tension_only_width on, twice continuously
/// differentiable between, so that Newton's method converges across slackening. A linear stiffness of
/// tension_only_remainder of the initial modulus stays everywhere: what hangs on slack cords alone is soft but no
/// mechanism. Energy convex where the law's is; no stress at rest.
UniaxialResponse tension_only_response(const dataset::YeohMaterial &material, double lambda);
inline constexpr double tension_only_width = 0.01;
inline constexpr double tension_only_remainder = 1e-3;

double bar_energy(const Bar &bar, const Eigen::VectorXd &solution); ///< N mm
/// Force of the bar on its first node, N: towards the other end where the bar is stretched. The other end gets its
/// opposite.
Eigen::Vector3d bar_pull(const Bar &bar, const Eigen::VectorXd &solution);

/// Hyperelastic bars at finite strain: energy A L W(l / L).
class Trusses : public Term
{
public:
  explicit Trusses(std::vector<Bar> bars);

  std::string name() const override { return "trusses"; }
  int n_items() const override { return static_cast<int>(bars_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  std::vector<Bar> bars_;
};
} // namespace pelvireg::reference_fe
