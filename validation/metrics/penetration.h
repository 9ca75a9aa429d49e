// How deep two closed surfaces reach into each other: the judge's own answer, point by point.
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/metrics/inside_test.h"
#include "validation/metrics/surface_distance.h"

#include <vector>

namespace pelvireg::metrics
{
/// A probe of one surface that lies inside the other.
struct Penetration
{
  double depth = 0;                             ///< mm, to the closest scored triangle of the other surface; 0: apart
  Eigen::Vector3d at = Eigen::Vector3d::Zero(); ///< the deepest probe, mm; zero when there is none
  int n_inside = 0;                             ///< probes of both surfaces inside the other
};

/// Is p inside the closed surface? By the solid angle that the surface subtends (Van Oosterom & Strackee, IEEE Trans.
/// Biomed. Eng. 30, 1983): no ray, no direction, every triangle counts, caps included. Slow: the witness of InsideTest.
bool is_inside(const Eigen::Vector3d &p, const dataset::Points &points, const dataset::Triangles &triangles);

/// A closed surface made ready to be compared with several others.
class ProbedSurface
{
public:
  /// Throws InputError as SurfaceTree does.
  ProbedSurface(const dataset::Points &points, const dataset::Triangles &triangles, const dataset::Integers &region);

  /// Its scored triangles.
  const SurfaceTree &tree() const { return tree_; }

private:
  friend Penetration penetration(const ProbedSurface &a, const ProbedSurface &b);
  void probe(const ProbedSurface &other, Penetration &result) const;

  SurfaceTree tree_;
  InsideTest inside_;
  std::vector<Eigen::Vector3d> probes_;
  Eigen::Vector3d lower_, upper_;
};

/// Deepest probe, both ways. Probes are the nodes and the centroids of scored triangles (caps are not scored).
Penetration penetration(const ProbedSurface &a, const ProbedSurface &b);
/// The same of two surfaces that are compared once. Throws InputError as require_usable_surface does.
Penetration penetration(const dataset::SurfaceMesh &a, const dataset::SurfaceMesh &b);
} // namespace pelvireg::metrics
