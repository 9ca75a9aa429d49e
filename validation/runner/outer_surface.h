// The outer surface of a registered organ, cut loose from its volume mesh.
#pragma once

#include "synthetic/dataset/anatomy.h"
#include "synthetic/dataset/geometry.h"

#include <string>
#include <vector>

namespace pelvireg::runner
{
/// Triangles of a body's outer surface over the nodes that they use, in the order of the body's node numbers.
struct OuterSurface
{
  dataset::SurfaceMesh rest;
  std::vector<int> nodes; ///< node i of `rest` is node nodes[i] of the body, 0-based

  /// The surface's share of positions of the whole body (n x 3, mm).
  dataset::Points pick(const dataset::Points &body_positions) const;
};

/// Throws InputError when the body has no outer surface or an index out of range.
OuterSurface outer_surface(const dataset::RegistrationBody &body);

/// Index of the body of this name. Throws InputError, naming the bodies that are there, when it is missing.
int body_index(const dataset::RegistrationModel &model, const std::string &name);
} // namespace pelvireg::runner
