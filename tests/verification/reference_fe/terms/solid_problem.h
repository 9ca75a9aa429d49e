// A solid of quadratic tetrahedra on a mapped block, its supports and tractions.
#pragma once

#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace pelvireg::reference_fe
{
/// A block of n bricks whose unit coordinates are moved by `map`.
inline dataset::ReferenceSolid mapped_block(const Eigen::Vector3i &n,
                                            const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &map)
{
  dataset::ReferenceSolid solid = block_solid(n, Eigen::Vector3d::Ones());
  for (Eigen::Index i = 0; i < solid.points.rows(); ++i)
    solid.points.row(i) = map(solid.points.row(i).transpose()).transpose();
  return solid;
}

struct SolidProblem
{
  dataset::ReferenceSolid solid, unit;
  EquilibriumSystem system;
  Eigen::VectorXd solution;

  SolidProblem(const Eigen::Vector3i &n, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &map,
               const dataset::YeohMaterial &material)
      : solid(mapped_block(n, map)), unit(block_solid(n, Eigen::Vector3d::Ones()))
  {
    system.add_unknowns(3 * n_nodes(), {"solid"});
    system.add_term(std::make_shared<QuadraticTetrahedra>(solid, material, 0));
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  int n_nodes() const { return static_cast<int>(solid.points.rows()); }
  /// Is the node on the side `value` (0 or 1) of unit coordinate `axis`?
  bool is_on(int node, int axis, double value) const { return std::abs(unit.points(node, axis) - value) < 1e-9; }
  void fix(int axis, double value, const std::vector<int> &components)
  {
    for (int node = 0; node < n_nodes(); ++node)
      if (is_on(node, axis, value))
        for (const int k : components)
          system.fix(3 * node + k);
  }
  std::vector<SurfaceFace> faces(int axis, double value) const
  {
    std::vector<SurfaceFace> found;
    for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
      if (is_on(solid.faces(f, 0), axis, value) && is_on(solid.faces(f, 1), axis, value) &&
          is_on(solid.faces(f, 2), axis, value))
        found.push_back(solid_face(solid, 0, f));
    return found;
  }
  /// A uniform traction on flat triangles: a third of the area on each mid-side node, nothing on the corners.
  std::vector<std::pair<int, double>> traction(int axis, double value, int component, double size) const
  {
    std::map<int, double> force;
    for (const SurfaceFace &face : faces(axis, value))
    {
      const Eigen::Vector3d a = face.nodes[1].rest - face.nodes[0].rest, b = face.nodes[2].rest - face.nodes[0].rest;
      for (int k = 3; k < 6; ++k)
        force[face.nodes[k].first_unknown + component] += size * a.cross(b).norm() / 6;
    }
    return {force.begin(), force.end()};
  }
  void solve()
  {
    const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-8, .max_iterations = 40});
    EXPECT_TRUE(result.converged()) << result.message;
  }
};
} // namespace pelvireg::reference_fe
