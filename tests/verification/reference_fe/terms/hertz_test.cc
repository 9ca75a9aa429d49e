// Hertz: a rigid cylinder pressed into a large block.
#include "reference_fe/contact/penalty_contact.h"
#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
const dataset::YeohMaterial material = {0.1, 0, 0, 40}; // kappa/mu = 200
constexpr double radius = 120, side = 60, thickness = 2, rest_gap = 0.05;
constexpr int n_cells = 18;

/// Half of a block under plane strain, its cells growing away from the line (0, y, side) that the cylinder touches.
dataset::ReferenceSolid graded_block()
{
  dataset::ReferenceSolid block = block_solid({n_cells, 1, n_cells}, {side, thickness, side});
  const auto graded = [](double x)
  {
    const auto line = [](double i) { return side * std::expm1(4 * i / n_cells) / std::expm1(4); };
    const double i = x / side * n_cells, low = std::floor(i + 1e-9);
    return i - low > 0.25 ? 0.5 * (line(low) + line(low + 1)) : line(low);
  };
  for (Eigen::Index p = 0; p < block.points.rows(); ++p)
  {
    block.points(p, 0) = graded(block.points(p, 0));
    block.points(p, 2) = side - graded(side - block.points(p, 2));
  }
  return block;
}

/// Half of the cylinder's lower side, 0 < x < width, its lowest line at (0, y, side + rest_gap); it looks down.
std::vector<SurfaceFace> cylinder_faces(int n, double width, int first_unknown)
{
  static constexpr int column[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, row[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  std::vector<SurfaceFace> faces;
  for (int i = 0; i < 2 * n; i += 2)
  {
    SurfaceFace face;
    for (int k = 0; k < 9; ++k)
    {
      SurfaceNode node;
      node.first_unknown = first_unknown + 3 * (3 * (i + row[k]) + column[k]);
      const double x = width * (i + row[k]) / (2. * n), y = thickness * column[k] / 2;
      node.rest = {x, y, side + rest_gap + radius - std::sqrt(radius * radius - x * x)};
      face.nodes.push_back(node);
    }
    faces.push_back(face);
  }
  return faces;
}

struct PressedBlock
{
  EquilibriumSystem system;
  dataset::ReferenceSolid block;
  int first_cylinder = 0, n_cylinder = 0;
  std::shared_ptr<PenaltyContact> contact;
  Eigen::VectorXd solution;

  PressedBlock(int n_faces) : block(graded_block())
  {
    system.add_unknowns(3 * static_cast<int>(block.points.rows()), {"block"});
    system.add_term(std::make_shared<QuadraticTetrahedra>(block, material, 0));
    for (Eigen::Index i = 0; i < block.points.rows(); ++i)
      for (int k = 0; k < 3; ++k)
        if (k == 1 || block.points(i, k) < 1e-9) // plane strain, the plane of symmetry, and the bottom
          system.fix(3 * static_cast<int>(i) + k);
    n_cylinder = 3 * (2 * n_faces + 1);
    first_cylinder = system.add_unknowns(3 * n_cylinder, {"cylinder"});
    for (int i = 0; i < 3 * n_cylinder; ++i)
      system.fix(first_cylinder + i);
    ContactFaces top{"block", {}, false};
    for (Eigen::Index f = 0; f < block.faces.rows(); ++f)
      if ((block.points(block.faces.row(f).transpose().head<3>().eval(), 2).array() > side - 1e-9).all())
        top.faces.push_back(solid_face(block, 0, f));
    const ContactOptions options = {.penalty = 4, .onset = 0.002, .search_distance = 2, .settled_gap = 1e-5};
    contact = std::make_shared<PenaltyContact>(
        std::vector<ContactFaces>{top, {"cylinder", cylinder_faces(n_faces, 12, first_cylinder), false}},
        std::vector<std::pair<int, int>>{{0, 1}}, options);
    system.add_term(contact);
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
  }
  void press_to(double depth)
  {
    for (int i = 0; i < n_cylinder; ++i)
      solution[first_cylinder + 3 * i + 2] = -rest_gap - depth;
    contact->search(solution);
    for (int search = 0; search < 12; ++search)
    {
      const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-9, .max_merit_growth = 1});
      ASSERT_TRUE(result.converged()) << depth << " " << result.message;
      if (!contact->search(solution))
        return;
    }
    FAIL() << "the pairs do not settle at depth " << depth;
  }
  /// On the whole cylinder, N per mm of its length.
  double force() const
  {
    double sum = 0;
    for (int i = 0; i < n_cylinder; ++i)
      sum += system.residual()[first_cylinder + 3 * i + 2];
    return -2 * sum / thickness;
  }
};

TEST(Contact, PressesACylinderIntoABlockAsHertzSays)
{
  const double g = 2 * material.c10, k = material.kappa;
  const double nu = (3 * k - 2 * g) / (6 * k + 2 * g), reduced_modulus = 2 * g / (1 - nu);
  PressedBlock pressed(24);
  for (const double depth : {0.02, 0.06, 0.12, 0.2})
  {
    pressed.press_to(depth);
    if (HasFatalFailure())
      return;
  }
  const double force = pressed.force();
  const double half_width = std::sqrt(4 * force * radius / (std::numbers::pi * reduced_modulus));
  const double largest_pressure = 2 * force / (std::numbers::pi * half_width);
  // Tractions at single points scatter; a tenth of the half width holds a dozen of them.
  double carried = 0, reach = 0;
  std::array<double, 8> area{}, mean{}, hertz{};
  for (const ContactTraction &t : pressed.contact->tractions(pressed.solution))
  {
    if (t.part != "block")
      continue;
    const double r = t.position.x() / half_width;
    carried += 2 * t.traction * t.area / thickness;
    if (t.traction > 0.05 * largest_pressure)
      reach = std::max(reach, r);
    if (!(r < 0.8))
      continue;
    const auto tenth = static_cast<std::size_t>(10 * r);
    area[tenth] += t.area;
    mean[tenth] += t.area * t.traction;
    hertz[tenth] += t.area * largest_pressure * std::sqrt(1 - r * r);
  }
  double worst = 0;
  for (std::size_t i = 0; i < area.size(); ++i)
    worst = std::max(worst, std::abs(mean[i] - hertz[i]) / (area[i] * largest_pressure));
  std::cout << fmt::format("force {:.5f} N/mm ({:.5f} from the tractions), Hertz' half width {:.3f} mm and largest "
                           "pressure {:.5f} MPa: pressures off by at most {:.2f} % of it within 0.8 half widths; "
                           "contact reaches {:.3f} half widths\n",
                           force, carried, half_width, largest_pressure, 100 * worst, reach);
  EXPECT_LT(worst, 0.03);
  EXPECT_NEAR(reach, 1, 0.08);
  EXPECT_NEAR(carried / force, 1, 0.01);
}
} // namespace
} // namespace pelvireg::reference_fe
