// Abdominal pressure on the peritoneal surfaces.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "reference_fe/term.h"

namespace pelvireg::reference_fe
{
/// Pressure p (one global unknown, MPa) on the current outer faces, against their outward normal:
/// residual of node i = p int N_i (x,xi cross x,eta) d(xi, eta). Exact tangent, with the column of p; the row of p is
/// left to the term that fixes the load factor (DisplacementProbe). In general not symmetric (fixed rims).
class FollowerPressure : public Term
{
public:
  FollowerPressure(std::vector<SurfaceFace> faces, int pressure_unknown);

  std::string name() const override { return "follower pressure"; }
  int n_items() const override { return static_cast<int>(faces_.size()); }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

  const std::vector<SurfaceFace> &faces() const { return faces_; }
  int pressure_unknown() const { return pressure_; }
  /// Sum of the forces on the faces, N.
  Eigen::Vector3d resultant(const Eigen::VectorXd &solution) const;

private:
  std::vector<SurfaceFace> faces_;
  int pressure_;
};

/// Rate at which a face sweeps volume outward, int v . (x,xi cross x,eta): nodal positions (mm) and velocities (mm/s),
/// a column a node; mm^3/s.
double swept_rate(const Eigen::Matrix3Xd &positions, const Eigen::Matrix3Xd &velocities);
} // namespace pelvireg::reference_fe
