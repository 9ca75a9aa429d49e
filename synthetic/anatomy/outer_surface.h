// The one geometry of an organ's outer surface, as a set of parametric charts. Reference and registration meshes are
// two discretisations of it.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::anatomy
{
/// A point of an outer surface.
struct SurfacePoint
{
  Eigen::Vector3d position; ///< mm
  Eigen::Vector3d normal;   ///< unit, outward
};

/// A four-sided piece of a surface: (a, b) in [0, 1]^2 to space. Neighbouring charts meet along whole sides and place
/// the same points on them, so that meshes with the same counts weld.
struct Chart
{
  int n_a = 1, n_b = 1; ///< quadrilaterals along a and b
  std::function<SurfacePoint(double, double)> evaluate;
  std::function<dataset::SurfaceRegion(const SurfacePoint &)> region; ///< of a cell, asked at its centre
  /// Share of the abdominal pressure, 0 … 1, asked at each node; none: 0. Charts that meet agree on it.
  std::function<double(const SurfacePoint &)> pressure_share;
};

/// From 0 to 1 around `border` over `width` (the slope is continuous): where the abdominal pressure sets in.
double fade_in(double at, double border, double width);
/// Charts on which the pressure fades in: `share` of it everywhere, region peritoneal where it is more than half.
void carry_pressure(Chart &chart, const std::function<double(const SurfacePoint &)> &share);

/// Nodes on the surface and quadratic quadrilaterals over them, counter-clockwise from outside.
struct QuadraticMesh
{
  dataset::Points points;
  dataset::Points normals; ///< averaged where charts meet
  dataset::Quads9 cells;
  dataset::Integers region;
  Eigen::VectorXd pressure_share; ///< of the nodes
};

/// Nodes on the surface and linear triangles over them, counter-clockwise from outside.
struct TriangleMesh
{
  dataset::Points points;
  dataset::Points normals;
  dataset::Triangles triangles;
  dataset::Integers region;
};

/// Welded quadratic mesh of all charts. Throws ComputationError when two charts do not meet.
QuadraticMesh quadratic_mesh(const std::vector<Chart> &charts);

/// Welded triangle mesh: every quadrilateral cut along its shorter diagonal.
TriangleMesh triangle_mesh(const std::vector<Chart> &charts);

/// Boundary loops of an oriented surface given by the boundary edges of its cells in cell direction (each row: from,
/// to, or from, middle, to). Ordered by their smallest node; each starts at its smallest corner node.
std::vector<dataset::Integers> boundary_loops(const dataset::Quads9 &cells);
std::vector<dataset::Integers> boundary_loops(const dataset::Triangles &triangles);

/// Outward normal by central differences of a map over two parameters; the sign is the caller's.
Eigen::Vector3d normal_by_differences(const std::function<Eigen::Vector3d(double, double)> &map, double u, double v,
                                      double step_u, double step_v);
} // namespace pelvireg::anatomy
