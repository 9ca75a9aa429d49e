// Contact's patch test: two blocks, meshes not matching, pressed onto each other by a uniform pressure.
#include "reference_fe/constraints/follower_pressure.h"
#include "reference_fe/contact/penalty_contact.h"
#include "reference_fe/elements/quadratic_tetrahedron.h"
#include "reference_fe/newton_solver.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

namespace pelvireg::reference_fe
{
namespace
{
const dataset::YeohMaterial material = {0.1, 0, 0, 40}; // kappa/mu = 200
constexpr double width = 12, height = 6, rest_gap = 0.7, pressure = 0.02;

/// The faces at height z at rest. Both blocks end at the same edges, so contact goes up to them.
ContactFaces contact_faces(const dataset::ReferenceSolid &solid, int first_unknown, double z)
{
  ContactFaces contact{solid.name, {}, false};
  for (Eigen::Index f = 0; f < solid.faces.rows(); ++f)
    if (((solid.points(solid.faces.row(f).transpose().head<3>().eval(), 2).array() - z).abs() < 1e-9).all())
      contact.faces.push_back(solid_face(solid, first_unknown, f));
  return contact;
}

struct TwoBlocks
{
  EquilibriumSystem system;
  dataset::ReferenceSolid lower, upper;
  int first_upper = 0;
  ContactOptions options;
  std::shared_ptr<PenaltyContact> contact;
  Eigen::VectorXd solution;

  TwoBlocks(int n_lower, int n_upper)
      : lower(block_solid({n_lower, n_lower, 2}, {width, width, height})),
        upper(block_solid({n_upper, n_upper, 2}, {width, width, height}))
  {
    upper.points.col(2).array() += height + rest_gap;
    options.penalty = 0.8; // as in the pelvis
    options.onset = 0.6;
    add_block(lower);
    first_upper = add_block(upper);
    for (Eigen::Index i = 0; i < lower.points.rows(); ++i)
      if (lower.points(i, 2) < 1e-9)
        system.fix(3 * static_cast<int>(i) + 2);
    contact = std::make_shared<PenaltyContact>(
        std::vector<ContactFaces>{contact_faces(lower, 0, height),
                                  contact_faces(upper, first_upper, height + rest_gap)},
        std::vector<std::pair<int, int>>{{0, 1}}, options);
    system.add_term(contact);
    const int load = system.add_unknowns(1, {"load"});
    std::vector<SurfaceFace> top;
    for (Eigen::Index f = 0; f < upper.faces.rows(); ++f)
      if ((upper.points(upper.faces.row(f).transpose().head<3>().eval(), 2).array() > 2 * height + rest_gap - 1e-9)
              .all())
        top.push_back(solid_face(upper, first_upper, f));
    system.add_term(std::make_shared<FollowerPressure>(top, load));
    system.fix(load);
    solution = Eigen::VectorXd::Zero(system.n_unknowns());
    for (int i = first_upper + 2; i < load; i += 3)
      solution[i] = -0.3; // in contact: else nothing would hold the upper block
    solution[load] = pressure;
  }
  /// Rollers on the sides x = 0 and y = 0; the other sides are free.
  int add_block(const dataset::ReferenceSolid &block)
  {
    const int first = system.add_unknowns(3 * static_cast<int>(block.points.rows()), {block.name});
    system.add_term(std::make_shared<QuadraticTetrahedra>(block, material, first));
    for (Eigen::Index i = 0; i < block.points.rows(); ++i)
      for (int k = 0; k < 2; ++k)
        if (block.points(i, k) < 1e-9)
          system.fix(first + 3 * static_cast<int>(i) + k);
    return first;
  }
  void solve()
  {
    contact->search(solution);
    for (int search = 0; search < 8; ++search)
    {
      const NewtonResult result = solve_newton(system, solution, {.residual_tolerance = 1e-10});
      ASSERT_TRUE(result.converged()) << result.message;
      if (!contact->search(solution))
        return;
    }
    FAIL() << "the pairs do not settle";
  }
  /// Where the nodes of a block are that lay at height z at rest.
  std::vector<Eigen::Vector3d> nodes_at(const dataset::ReferenceSolid &block, int first, double z) const
  {
    std::vector<Eigen::Vector3d> found;
    for (Eigen::Index i = 0; i < block.points.rows(); ++i)
      if (std::abs(block.points(i, 2) - z) < 1e-9)
        found.push_back(block.points.row(i).transpose() + solution.segment<3>(first + 3 * i));
    return found;
  }
};

/// Heights of a layer of nodes: their mean, and the largest distance from it of those at least 3 mm from the edge.
struct Layer
{
  double mean = 0, unevenness = 0;

  explicit Layer(const std::vector<Eigen::Vector3d> &nodes)
  {
    for (const Eigen::Vector3d &x : nodes)
      mean += x.z() / static_cast<double>(nodes.size());
    for (const Eigen::Vector3d &x : nodes)
      if (x.head<2>().minCoeff() > 2.9 && x.head<2>().maxCoeff() < width - 2.9)
        unevenness = std::max(unevenness, std::abs(x.z() - mean));
  }
};

/// Stretch of an incompressible neo-Hookean block under the Cauchy stress -p: 2 C10 (lambda^2 - 1 / lambda) = -p.
double compressed_stretch()
{
  double low = 0.5, high = 1;
  for (int i = 0; i < 60; ++i)
  {
    const double l = (low + high) / 2;
    (2 * material.c10 * (l * l - 1 / l) < -pressure ? low : high) = l;
  }
  return low;
}

TEST(Contact, PassesAUniformPressureFromBlockToBlock)
{
  // 20 kPa. Integration points of one face lie on either side of the other's edges: what the touching faces are uneven
  // by falls with the size of the bricks. The blocks widen under the pressure, which is given per area at rest.
  const double lambda = compressed_stretch();
  double unevenness[2];
  for (int level = 0; level < 2; ++level)
  {
    TwoBlocks blocks(4 << level, 3 << level);
    blocks.solve();
    if (HasFatalFailure())
      return;
    double reaction = 0;
    for (Eigen::Index i = 0; i < blocks.lower.points.rows(); ++i)
      if (blocks.lower.points(i, 2) < 1e-9)
        reaction += blocks.system.residual()[3 * i + 2];
    EXPECT_NEAR(reaction, pressure * width * width / lambda, 1e-3 * reaction);

    const Layer middle(blocks.nodes_at(blocks.lower, 0, height / 2)), face(blocks.nodes_at(blocks.lower, 0, height)),
        opposite(blocks.nodes_at(blocks.upper, blocks.first_upper, height + rest_gap)),
        top(blocks.nodes_at(blocks.upper, blocks.first_upper, 2 * height + rest_gap));
    const double onset = blocks.options.onset;
    const double gap_by_law = onset - std::sqrt(4 * onset * pressure / blocks.options.penalty);
    const double gap = opposite.mean - face.mean, top_by_law = 2 * height * lambda + gap_by_law;
    EXPECT_NEAR(middle.mean, height / 2 * lambda, 1e-3);
    EXPECT_LT(middle.unevenness, level == 0 ? 0.002 : 0.0005);
    EXPECT_NEAR(gap, gap_by_law, 0.006);
    EXPECT_NEAR(top.mean, top_by_law, 0.006);
    unevenness[level] = std::max(face.unevenness, opposite.unevenness);
    std::cout << fmt::format("{} on {} bricks: reaction {:.4f} N, gap {:.4f} mm (law {:.4f}), top {:.4f} mm (closed "
                             "form {:.4f}), faces uneven by {:.4f} mm, half a block away by {:.4f} mm\n",
                             3 << level, 4 << level, reaction, gap, gap_by_law, top.mean, top_by_law, unevenness[level],
                             middle.unevenness);
  }
  EXPECT_LT(unevenness[0], 0.011);
  EXPECT_LT(unevenness[1], 0.55 * unevenness[0]);
}
} // namespace
} // namespace pelvireg::reference_fe
