// Surfaces as one binary glTF 2.0 file (.glb): Khronos Group, glTF 2.0 specification, version 2.0.1 (ISO/IEC 12113).
#pragma once

#include "synthetic/dataset/geometry.h"
#include "validation/report/colour_map.h"

#include <map>
#include <string>
#include <vector>

namespace pelvireg::report
{
/// Triangles of one colour, or coloured point by point.
struct GltfPart
{
  dataset::Triangles triangles; ///< m x 3, into the mesh's points
  Colour colour = {1, 1, 1};    ///< of all, when the points' colours are not used
  double opacity = 1;
  bool has_point_colours = false;
};

/// One named surface.
struct GltfMesh
{
  std::string name;
  dataset::Points points;            ///< n x 3, mm, LPS
  std::vector<Colour> point_colours; ///< n, or none
  std::vector<double> error;         ///< n, mm, or none: vertex attribute `_ERROR_MM`
  std::vector<GltfPart> parts;
};

struct GltfScene
{
  std::string name;
  std::map<std::string, std::string> remarks; ///< into `asset.extras`
  std::vector<GltfMesh> meshes;
};

/// Metres, +Y up, +Z forward as glTF wants it: (x, y, z) in mm, LPS becomes (x, z, -y) / 1000, a rotation, so that the
/// patient stands and looks along +Z. Colours are sRGB here and linear in the file. Normals are means of the triangles'
/// normals, by area. Empty parts and meshes without triangles are left out. The same scene gives the same bytes. Throws
/// std::invalid_argument for an index out of range, colours or errors that are not one a point, and a number that is
/// not finite.
std::string glb(const GltfScene &scene);
} // namespace pelvireg::report
