// Abdominal pressure on the peritoneal surfaces.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// Share s of the pressure p (one global unknown, MPa) on the current outer faces, against their outward normal:
/// residual of node i = p int s N_i (x,xi cross x,eta) d(xi, eta), s carried by the material. Exact tangent, with the
/// column of p; the row of p is left to the term that fixes the load factor (DisplacementProbe). In general not
/// symmetric (fixed rims).
class FollowerPressure : public Term
{
public:
  /// `shares`: s at the nodes of each face, interpolated as positions are; none: 1 everywhere.
  FollowerPressure(std::vector<SurfaceFace> faces, int pressure_unknown, std::vector<Eigen::VectorXd> shares = {});

  std::string name() const override { return "follower pressure"; }
  int n_items() const override { return static_cast<int>(faces_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  const std::vector<SurfaceFace> &faces() const { return faces_; }
  const std::vector<Eigen::VectorXd> &shares() const { return shares_; }
  int pressure_unknown() const { return pressure_; }
  /// Sum of the forces on the faces, N.
  Eigen::Vector3d resultant(const Eigen::VectorXd &solution) const;

private:
  std::vector<SurfaceFace> faces_;
  std::vector<Eigen::VectorXd> shares_;
  int pressure_;
};

/// Rate at which a face sweeps volume outward, int s v . (x,xi cross x,eta): nodal positions (mm) and velocities
/// (mm/s), a column a node, and shares s; mm^3/s.
double swept_rate(const Eigen::Matrix3Xd &positions, const Eigen::Matrix3Xd &velocities, const Eigen::VectorXd &shares);
} // namespace pelvireg::reference_fe
