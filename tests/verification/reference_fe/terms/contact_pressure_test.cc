// Contact's patch test without a border: a sphere is blown up inside another one, whose mesh does not match.
#include "reference_fe/constraints/cavity.h"
#include "reference_fe/contact/penalty_contact.h"
#include "reference_fe/newton_solver.h"
#include "tests/verification/reference_fe/terms/sphere_shell.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace pelvireg::reference_fe
{
namespace
{
constexpr YeohCoefficients wall = {0.1, 0.05};
constexpr double thickness = 1, inner_radius = 20, outer_radius = 22;

/// The outer (+1) or inner (-1) face of a sphere, away from the wall.
ContactFaces contact_faces(const Sphere &sphere, int side)
{
  static constexpr int reversed[9] = {0, 3, 2, 1, 7, 6, 5, 4, 8};
  ContactFaces contact;
  for (Eigen::Index c = 0; c < sphere.shell.cells.rows(); ++c)
  {
    const SurfaceFace face = shell_face(sphere.shell, sphere.first, c, side);
    std::vector<SurfaceNode> nodes;
    for (int i = 0; i < 9; ++i)
      nodes.push_back(face.nodes[side > 0 ? i : reversed[i]]);
    contact.faces.push_back({nodes});
  }
  return contact;
}

/// Inner minus outer pressure of a wall whose outer face has the given radius, by its closed form.
double wall_pressure(double rest_radius, double outer_face_radius)
{
  const double a = rest_radius - thickness / 2, b = rest_radius + thickness / 2;
  const double inner_face_radius = std::cbrt(std::pow(outer_face_radius, 3) - b * b * b + a * a * a);
  return sphere_pressure(inner_face_radius / a, a, b, wall, Sphere::kappa(wall));
}

struct NestedSpheres
{
  ContactOptions options;
  EquilibriumSystem system;
  Sphere inner, outer;
  int pressure;
  std::shared_ptr<Cavity> fluid;
  std::shared_ptr<PenaltyContact> contact;
  Eigen::VectorXd solution;

  NestedSpheres(int n_inner, int n_outer)
      : inner(system, n_inner, inner_radius, thickness, wall), outer(system, n_outer, outer_radius, thickness, wall)
  {
    options.penalty = 0.8; // as in the pelvis
    options.onset = 0.6;
    pressure = system.add_unknowns(1, {"pressure", 1e3});
    fluid = std::make_shared<Cavity>("fluid", inner.faces(-1), pressure);
    system.add_term(fluid);
    contact = std::make_shared<PenaltyContact>(
        std::vector<ContactFaces>{contact_faces(inner, +1), contact_faces(outer, -1)},
        std::vector<std::pair<int, int>>{{0, 1}}, options);
    system.add_term(contact);
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  void inflate_to(double stretch)
  {
    fluid->hold_volume(fluid->rest_volume() * std::pow(stretch, 3));
    for (int search = 0; search < 8; ++search)
    {
      const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-7});
      ASSERT_TRUE(result.converged()) << stretch << " " << result.message;
      if (!contact->search(solution))
        return;
    }
    FAIL() << "the pairs do not settle at stretch " << stretch;
  }
};

TEST(Contact, TransmitsAUniformPressureBetweenNonMatchingCurvedWalls)
{
  NestedSpheres spheres(3, 4);
  for (const double stretch : {1.01, 1.02, 1.025, 1.03, 1.035, 1.04})
  {
    spheres.inflate_to(stretch);
    if (HasFatalFailure())
      return;
  }
  const Eigen::VectorXd outside = spheres.inner.radii(spheres.solution, +1),
                        inside = spheres.outer.radii(spheres.solution, -1),
                        far_side = spheres.outer.radii(spheres.solution, +1);
  const auto sphere_area = [](double r) { return 4 * std::numbers::pi * r * r; };
  const double given =
      sphere_area(outside.mean()) * (spheres.solution[spheres.pressure] - wall_pressure(inner_radius, outside.mean()));
  const double taken = sphere_area(inside.mean()) * wall_pressure(outer_radius, far_side.mean());
  EXPECT_NEAR(given / taken, 1, 2e-3);

  // The law's gap at that pressure.
  const double pressure = taken / sphere_area(inside.mean());
  const double gap = inside.mean() - outside.mean(), onset = spheres.options.onset;
  const double gap_by_law = onset - std::sqrt(4 * onset * pressure / spheres.options.penalty);
  EXPECT_NEAR(gap, gap_by_law, 0.02);
  const double spread = (inside.array() - inside.mean()).abs().maxCoeff();
  EXPECT_LT(spread, 0.04);
  std::cout << fmt::format(
      "the inner wall gives {:.4f} N, the outer takes {:.4f} N ({:.6f} MPa); gap {:.4f} mm, by the "
      "law {:.4f} mm; radii of {:.3f} mm within {:.4f} mm; {} pairs\n",
      given, taken, pressure, gap, gap_by_law, inside.mean(), spread, spheres.contact->n_in_contact(spheres.solution));
}
} // namespace
} // namespace pelvireg::reference_fe
