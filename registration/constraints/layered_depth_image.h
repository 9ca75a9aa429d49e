// All crossings of a bundle of parallel rays with two closed surfaces (layered depth image; Faure, Barbier, Allard,
// Falipou, "Image-based collision detection and response between arbitrary volume objects", SCA 2008).
#pragma once

#include "registration/registration.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelvireg::registration
{
/// Where a ray crosses a triangle.
struct Fragment
{
  double depth = 0;                ///< coordinate along the ray's axis, mm
  std::array<double, 3> weights{}; ///< barycentric, in [0, 1], sum 1
  int triangle = 0;                ///< row of the surface's triangles
  std::int8_t side = 0;            ///< 0, 1: which of the two surfaces
  bool leaves = false;             ///< the ray leaves the body here, going up its axis
};

/// Rays along `axis` through the pixels' centres ((i + 1/2) p, (j + 1/2) p) of the two axes that follow it cyclically.
/// The raster is fixed in space, so that bodies which stay still are seen alike at every step.
class LayeredDepthImage
{
public:
  /// Set memory aside.
  void reserve(std::size_t n_rays, std::size_t n_fragments);

  /// Rays through the box (mm) at the spacing `pixel` (mm, > 0); forgets all fragments and keeps the memory.
  void aim(int axis, double pixel, const Eigen::AlignedBox3d &box);

  /// Rasterise surface `side` (0 first, then 1; surface 1 is only looked at where surface 0 was seen). Corners are
  /// snapped to multiples of `quantum` (mm, a power of two) and coverage is decided in integers with one rule for
  /// edges, so that a closed surface is crossed as often inward as outward by every ray, also through edges and
  /// corners.
  void rasterise(int side, const Triangles &triangles, const Points &positions, double quantum);

  int n_rays() const { return n_u_ * n_v_; }
  int axis() const { return axis_; }
  int u_axis() const { return (axis_ + 1) % 3; }
  int v_axis() const { return (axis_ + 2) % 3; }
  double pixel_area() const { return pixel_ * pixel_; }
  /// Crossings of one ray in ascending depth; equal depths by side, leaving last, then triangle. Refers to a buffer
  /// that the next call overwrites.
  const std::vector<const Fragment *> &crossings(int ray) const;
  /// Coordinates of a ray along u_axis() and v_axis(), mm.
  Eigen::Vector2d centre(int ray) const;

private:
  int axis_ = 0;
  double pixel_ = 1;
  int first_u_ = 0, first_v_ = 0, n_u_ = 0, n_v_ = 0;
  std::vector<Fragment> fragments_;
  std::vector<int> next_;  ///< fragment after this one on its ray; -1: none
  std::vector<int> heads_; ///< one a ray
  mutable std::vector<const Fragment *> sorted_;
};

/// The quantum at which the rasteriser's integers can hold the box exactly.
double raster_quantum(const Eigen::AlignedBox3d &box);
} // namespace pelvireg::registration
