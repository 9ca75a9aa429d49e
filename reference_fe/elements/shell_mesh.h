// Shells over deal.II triangulations: analytic geometries of any order, refined as deal.II refines.
#pragma once

#include "reference_fe/elements/shell_body.h"

#include <deal.II/grid/tria.h>

#include <functional>
#include <string>

namespace pelvireg::reference_fe
{
/// Nodes are the support points of FE_Q<2, 3>(order) under the triangulation's manifold, then moved by `map` (identity
/// when empty). Directors are the averaged normals; the triangulation's orientation says which side is outward.
ShellBody shell_body(const dealii::Triangulation<2, 3> &triangulation, const std::string &name, int order,
                     double thickness, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &map = {});
} // namespace pelvireg::reference_fe
