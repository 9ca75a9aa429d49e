// How far a mesh's elements are from turning inside out.
#pragma once

#include "synthetic/dataset/geometry.h"

namespace pelvireg::metrics
{
/// Volume ratio J of the elements of one mesh, deformed over rest.
struct ElementJacobian
{
  int n_elements = 0;
  int n_inverted = 0;  ///< with J <= 0
  double smallest = 0; ///< of J: 1 undeformed, 0 flat, negative inside out
};

/// J = det(deformed edges) / det(rest edges): of a linear tetrahedron the constant determinant of its deformation
/// gradient; of a trilinear hexahedron (VTK order) the least of the ratios at its eight corners, where alone it is
/// asked. rest, deformed: n x 3, mm. Throws InputError for other shapes, an index out of range, a value that is not
/// finite, an element that is not positive at rest, and a mesh without elements.
ElementJacobian element_jacobian(const dataset::Points &rest, const dataset::Points &deformed,
                                 const dataset::Tets &tets, const dataset::Hexes &hexes);
} // namespace pelvireg::metrics
