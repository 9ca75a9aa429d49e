// Contact as a whole, between the outer faces of two curved shells, with the pairs frozen after one search.
#include "reference_fe/contact/penalty_contact.h"
#include "reference_fe/outer_surface.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"
#include "tests/unit/reference_fe/terms/sample_parts.h"

#include <Eigen/Geometry>

namespace pelvireg::reference_fe
{
namespace
{
constexpr int n_node_unknowns = 7; // u, w, alpha

ContactFaces contact_faces(const dataset::ReferenceShell &shell, int first_unknown)
{
  ContactFaces contact{shell.name, {}};
  for (Eigen::Index c = 0; c < shell.cells.rows(); ++c)
    contact.faces.push_back(shell_face(shell, first_unknown, c, +1));
  return contact;
}

/// Two spheres of outer radius 3.2, apart at rest, pressed 0.2 mm into each other and dented at random.
class TwoSpheres : public ::testing::Test
{
protected:
  TwoSpheres()
  {
    upper.midsurface.rowwise() += Eigen::RowVector3d(0, 0, 9);
    n_lower = n_node_unknowns * static_cast<int>(lower.midsurface.rows());
    n_all = 2 * n_lower;
    contact = std::make_unique<PenaltyContact>(
        std::vector<ContactFaces>{contact_faces(lower, 0), contact_faces(upper, n_lower)},
        std::vector<std::pair<int, int>>{{0, 1}}, ContactOptions{});
    solution = 0.03 * scattered(n_all, 31);
    for (int i = n_lower; i < n_all; i += n_node_unknowns)
      solution.segment<3>(i) += Eigen::Vector3d(0.3, 0.2, 6.2 - 9);
    contact->search(solution);
    contact->update(solution);
  }

  double energy(const Eigen::VectorXd &x) const
  {
    double sum = 0;
    LocalSystem local;
    for (int item = 0; item < contact->n_items(); ++item)
    {
      contact->evaluate(item, x, local);
      sum += local.energy;
    }
    return sum;
  }
  /// Sum of the residuals, and tangent times `direction`.
  Eigen::VectorXd residual(const Eigen::VectorXd &x, const Eigen::VectorXd &direction, Eigen::VectorXd &change) const
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_all);
    change = sum;
    LocalSystem local;
    for (int item = 0; item < contact->n_items(); ++item)
    {
      contact->evaluate(item, x, local);
      sum(local.unknowns) += local.residual;
      if (local.tangent.size() > 0)
        change(local.unknowns) += local.tangent * direction(local.unknowns);
    }
    return sum;
  }
  Eigen::VectorXd residual(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd unused;
    return residual(x, x, unused);
  }
  /// Both spheres turned by `turn` about the origin, then moved.
  Eigen::VectorXd moved_rigidly(const Eigen::Matrix3d &turn, const Eigen::Vector3d &move) const
  {
    Eigen::VectorXd x = solution;
    for (int node = 0; node < n_all / n_node_unknowns; ++node)
    {
      x.segment<3>(n_node_unknowns * node) = turn * (rest(node) + displacement(node)) + move - rest(node);
      x.segment<3>(n_node_unknowns * node + 3) = turn * director(node) - rest_director(node);
    }
    return x;
  }
  Eigen::Vector3d row(const dataset::Points &low, const dataset::Points &high, int node) const
  {
    const int n = static_cast<int>(low.rows());
    return node < n ? low.row(node) : high.row(node - n);
  }
  Eigen::Vector3d rest(int node) const { return row(lower.midsurface, upper.midsurface, node); }
  Eigen::Vector3d rest_director(int node) const { return row(lower.directors, upper.directors, node); }
  Eigen::Vector3d displacement(int node) const { return solution.segment<3>(n_node_unknowns * node); }
  Eigen::Vector3d director(int node) const
  {
    return rest_director(node) + solution.segment<3>(n_node_unknowns * node + 3);
  }

  dataset::ReferenceShell lower = sphere_shell(4, 3, 0.4), upper = lower;
  int n_lower = 0, n_all = 0;
  std::unique_ptr<PenaltyContact> contact;
  Eigen::VectorXd solution;
};

const Eigen::Matrix3d some_turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();

TEST_F(TwoSpheres, TheForceIsTheGradientOfTheEnergyAndTheTangentItsDerivative)
{
  ASSERT_GT(contact->n_in_contact(solution), 10);
  const double step = 1e-6;
  for (unsigned seed = 41; seed < 44; ++seed)
  {
    const Eigen::VectorXd direction = scattered(n_all, seed);
    Eigen::VectorXd change;
    const Eigen::VectorXd force = residual(solution, direction, change);
    const Eigen::VectorXd plus = solution + step * direction, minus = solution - step * direction;
    EXPECT_NEAR((energy(plus) - energy(minus)) / (2 * step) / force.dot(direction), 1, 1e-7);
    const Eigen::VectorXd quotient = (residual(plus) - residual(minus)) / (2 * step);
    EXPECT_LT((quotient - change).norm() / change.norm(), 1e-7);
  }
}

TEST_F(TwoSpheres, ForcesAndMomentsOfActionAndReactionCancel)
{
  // A director of a shell carries the moment director x (force on w).
  const Eigen::VectorXd f = residual(solution);
  Eigen::Vector3d force[2] = {{0, 0, 0}, {0, 0, 0}}, moment[2] = {{0, 0, 0}, {0, 0, 0}};
  for (int node = 0; node < n_all / n_node_unknowns; ++node)
  {
    const int side = n_node_unknowns * node < n_lower ? 0 : 1;
    const Eigen::Vector3d on_u = f.segment<3>(n_node_unknowns * node), on_w = f.segment<3>(n_node_unknowns * node + 3);
    force[side] += on_u;
    moment[side] += (rest(node) + displacement(node)).cross(on_u) + director(node).cross(on_w);
  }
  EXPECT_GT(force[0].norm(), 0.05);
  EXPECT_GT(moment[0].norm(), 1e-3);
  EXPECT_LT((force[0] + force[1]).norm(), 1e-14);
  EXPECT_LT((moment[0] + moment[1]).norm(), 1e-13);
  // The residual is the internal force: what the contact does to the lower sphere has the opposite sign, downwards.
  EXPECT_GT(force[0].z(), 0);
}

TEST_F(TwoSpheres, ARigidMotionOfBothChangesNoEnergyAndFindsTheSamePairs)
{
  const double before = energy(solution);
  const int n_before = contact->n_in_contact(solution);
  const Eigen::VectorXd moved = moved_rigidly(some_turn, {20, -7, 11});
  EXPECT_NEAR(energy(moved) / before, 1, 1e-11);
  EXPECT_FALSE(contact->search(moved));
  EXPECT_FALSE(contact->update(moved)); // not one pair another
  EXPECT_EQ(contact->n_in_contact(moved), n_before);
  EXPECT_NEAR(energy(moved) / before, 1, 1e-11);
}

TEST_F(TwoSpheres, WhatIsApartFeelsNothing)
{
  Eigen::VectorXd apart = solution;
  for (int i = n_lower + 2; i < n_all; i += n_node_unknowns)
    apart[i] += 0.6; // 0.4 mm between the spheres, less the dents: beyond the onset of 0.2 mm
  contact->search(apart);
  EXPECT_EQ(energy(apart), 0);
  EXPECT_EQ(contact->n_in_contact(apart), 0);
}
} // namespace
} // namespace pelvireg::reference_fe
