// The equation of the load factor: how far the vagina has moved in the image plane.
#pragma once

#include "reference_fe/elements/surface_node.h"
#include "reference_fe/term.h"
#include "synthetic/dataset/geometry.h"

namespace pelvireg::reference_fe
{
/// A point where the plane cuts an edge of a triangulated surface at rest, with its share of the contour's length.
struct ProbePoint
{
  std::vector<SurfaceNode> nodes; ///< the two ends of the edge
  Eigen::Vector2d weights;        ///< of the two ends, sum 1
  double share = 0;               ///< of the contour's rest length, all shares sum to 1
};

/// The rest contour of a triangulated surface (`vertices`, outward `triangles`) in `plane`: end points of all segments,
/// each with half the length of its segments (trapezoidal rule). Triangles of region cap are left out.
/// Throws InputError when the plane misses the surface.
std::vector<ProbePoint> probe_points(const std::vector<SurfaceNode> &vertices, const dataset::Triangles &triangles,
                                     const dataset::Integers &region, const dataset::Plane &plane);

/// One row for the load factor p: either p - p0 = 0 (MPa), or g - t = 0 (mm) with g the mean over the rest contour of
/// the norm of the in-plane displacement of its material points (DESIGN 4). g has no derivative at rest: begin with a
/// small prescribed pressure.
class DisplacementProbe : public Term
{
public:
  DisplacementProbe(std::vector<ProbePoint> points, const Eigen::Vector3d &plane_normal, int pressure_unknown);

  void prescribe_pressure(double pressure);         ///< MPa
  void prescribe_displacement(double displacement); ///< mm
  /// Leave the row of the load factor to another term.
  void release() { control_ = Control::none; }
  double mean_displacement(const Eigen::VectorXd &solution) const; ///< g, mm

  std::string name() const override { return "displacement probe"; }
  int n_items() const override { return static_cast<int>(points_.size()) + 1; }
  void unknowns(int item, std::vector<int> &indices) const override;
  void evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const override;

private:
  Eigen::Vector3d in_plane_displacement(const ProbePoint &point, const Eigen::VectorXd &solution) const;

  std::vector<ProbePoint> points_;
  Eigen::Matrix3d projection_; ///< onto the plane
  int pressure_;
  enum class Control
  {
    none,
    pressure,
    displacement
  };
  Control control_ = Control::pressure;
  double target_ = 0;
};
} // namespace pelvireg::reference_fe
