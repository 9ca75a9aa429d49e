// The moving parts of the pelvis as an image sees them: walls, what they enclose, and how they move.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/truth.h"
#include "synthetic/observation/images/motion_field.h"

#include <string>
#include <vector>

namespace pelvireg::observation
{
enum class Tissue
{
  bladder, ///< wall around urine
  vagina,  ///< wall around gel
  rectum,  ///< wall around gel
  uterus,  ///< solid, in layers by depth
  floor    ///< a muscle plate
};

/// One part: its closed outer surface at rest and, for a hollow organ, how thick its wall is.
struct TissueBody
{
  std::string name;
  Tissue tissue = Tissue::uterus;
  dataset::SurfaceMesh rest;                  ///< closed
  Eigen::VectorXd wall;                       ///< mm at each node; empty for solid parts
  std::vector<dataset::Points> displacements; ///< at increments 0 (rest) … n
};

/// The parts of a truth, in the order of its surfaces. Walls take their thickness from the nearest node of the
/// anatomy's shell; the pelvic floor is extruded downwards by its own. Throws InputError when a part is missing.
std::vector<TissueBody> tissue_bodies(const dataset::Anatomy &anatomy, const dataset::Truth &truth);

/// Displacements at a time between increments, linear in between; `increment` is held to 0 … n.
dataset::Points displacements_at(const TissueBody &body, double increment);

/// The outer surface at that time.
dataset::SurfaceMesh outer_surface(const TissueBody &body, double increment);

/// The surface of what a hollow organ encloses. The wall keeps its volume: where the outer surface stretches it thins,
/// at most to half and to one and a half of its rest thickness. Through caps the lumen stays open.
dataset::SurfaceMesh inner_surface(const TissueBody &body, double increment);

/// Area of the triangles around each node, a third of each, mm^2.
Eigen::VectorXd node_areas(const dataset::Points &points, const dataset::Triangles &triangles);

/// What moves the tissue around all `bodies`, or inside one.
MovedPoints moved_points(const std::vector<TissueBody> &bodies, std::size_t increment);
MovedPoints moved_points(const TissueBody &body, std::size_t increment);
} // namespace pelvireg::observation
