// The triangulated outer surface of a part: what touches, what is cut by a plane, what is written as truth.
#pragma once

#include "reference_fe/elements/surface_face.h"
#include "synthetic/dataset/anatomy.h"

#include <string>
#include <vector>

namespace pelvireg::reference_fe
{
/// Triangles through the surface nodes: 8 of a 9-node quadrilateral, 4 of a 6-node triangle, and the caps of the rims.
struct OuterSurface
{
  std::string part;
  std::vector<SurfaceNode> vertices;
  dataset::Triangles triangles; ///< into `vertices`, outward
  dataset::Integers region;     ///< SurfaceRegion of each triangle
};

/// Surface node of a shell: side +1 outer, -1 inner, 0 mid-surface. Node n owns the unknowns first_unknown + 7 n … + 6.
SurfaceNode shell_node(const dataset::ReferenceShell &shell, int first_unknown, int node, int side);
/// Node of a solid; it owns the unknowns first_unknown + 3 n … + 2.
SurfaceNode solid_node(const dataset::ReferenceSolid &solid, int first_unknown, int node);

/// One face of zeta = side, outward as the cell.
SurfaceFace shell_face(const dataset::ReferenceShell &shell, int first_unknown, Eigen::Index cell, int side);
SurfaceFace solid_face(const dataset::ReferenceSolid &solid, int first_unknown, Eigen::Index face);

/// Shares of the abdominal pressure at the nodes of one outer face (dataset::ReferenceShell::pressure_share).
Eigen::VectorXd pressure_shares(const dataset::ReferenceShell &shell, Eigen::Index cell);
Eigen::VectorXd pressure_shares(const dataset::ReferenceSolid &solid, Eigen::Index face);

/// A rim as a loop that begins at a corner node and runs as the adjacent cells run along it.
/// Throws InputError when the rim is not a loop of cell edges.
std::vector<int> oriented_rim(const dataset::ReferenceShell &shell, const dataset::Integers &rim);

/// zeta = +1 of a shell, all nodes in their order, with caps over the rims (rim nodes only).
OuterSurface outer_surface(const dataset::ReferenceShell &shell, int first_unknown);
/// Boundary of a solid: its boundary nodes in ascending order.
OuterSurface outer_surface(const dataset::ReferenceSolid &solid, int first_unknown);

/// Where the surface of a part stands in truth.h5: organs in the order of every table, the pelvic floor, other parts.
int table_rank(const std::string &part);
} // namespace pelvireg::reference_fe
