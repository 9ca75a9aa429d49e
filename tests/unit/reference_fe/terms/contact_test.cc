#include "reference_fe/contact/closest_point.h"
#include "reference_fe/contact/facet_gap.h"
#include "reference_fe/contact/penalty_contact.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"

#include <Eigen/Geometry>

namespace pelvireg::reference_fe
{
namespace
{
/// A flat n x n patch of side 4 at height z; facing up or down.
ContactSurface patch(int n, double z, bool up, int first_unknown)
{
  ContactSurface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
    {
      SurfaceNode node;
      node.first_unknown = first_unknown + 3 * static_cast<int>(surface.vertices.size());
      node.rest = {4. * i / n, 4. * j / n, z};
      surface.vertices.push_back(node);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      surface.facets.push_back(up ? std::array{a, b, d} : std::array{a, d, b});
      surface.facets.push_back(up ? std::array{a, d, c} : std::array{a, c, d});
    }
  return surface;
}

class TwoPatches : public ::testing::Test
{
protected:
  static constexpr int n_lower = 3 * 25, n_all = n_lower + 3 * 16;
  PenaltyContact contact{{patch(4, 0, true, 0), patch(3, 1, false, n_lower)}, {{0, 1}}, {}};

  /// The upper patch moved down so that `gap` is left.
  Eigen::VectorXd with_gap(double gap) const
  {
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(n_all);
    for (int i = n_lower + 2; i < n_all; i += 3)
      solution[i] = gap - 1;
    return solution;
  }
};

TEST(ContactLaw, TractionAndSlopeAreContinuousAndDerivativesOfTheEnergy)
{
  const double onset = 0.2;
  for (const double border : {-onset, onset})
  {
    const ContactLaw below = contact_law(border - 1e-12, onset), above = contact_law(border + 1e-12, onset);
    EXPECT_NEAR(below.energy, above.energy, 1e-12);
    EXPECT_NEAR(below.d_energy, above.d_energy, 1e-11);
    EXPECT_NEAR(below.d2_energy, above.d2_energy, 1e-11);
  }
  for (const double gap : {-0.5, -0.1, 0.05, 0.3})
  {
    const double step = 1e-6;
    EXPECT_NEAR(contact_law(gap, onset).d_energy,
                (contact_law(gap + step, onset).energy - contact_law(gap - step, onset).energy) / (2 * step), 1e-9);
    EXPECT_NEAR(contact_law(gap, onset).d2_energy,
                (contact_law(gap + step, onset).d_energy - contact_law(gap - step, onset).d_energy) / (2 * step), 1e-9);
  }
}

TEST(FacetGap, GradientAndHessianAgreeWithDifferenceQuotientsAndActionEqualsReaction)
{
  Eigen::Matrix<double, 3, 4> x;
  x << 0.4, 0, 2, 0.3, 0.5, 0.1, 0, 1.7, 0.6, 0, 0.2, -0.1;
  const FacetGap at = facet_gap(x);
  const double step = 1e-5;
  for (int i = 0; i < 12; ++i)
  {
    Eigen::Matrix<double, 3, 4> plus = x, minus = x;
    plus.data()[i] += step;
    minus.data()[i] -= step;
    const FacetGap up = facet_gap(plus), down = facet_gap(minus);
    EXPECT_NEAR(at.gradient[i], (up.gap - down.gap) / (2 * step), 1e-9);
    EXPECT_LT((at.hessian.col(i) - (up.gradient - down.gradient) / (2 * step)).cwiseAbs().maxCoeff(), 1e-8);
  }
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> force(at.gradient.data());
  EXPECT_LT(force.rowwise().sum().norm(), 1e-14);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k)
    moment += Eigen::Vector3d(x.col(k)).cross(Eigen::Vector3d(force.col(k)));
  EXPECT_LT(moment.norm(), 1e-14);
}

TEST(ClosestPoint, FindsInsideEdgeAndCorner)
{
  const Eigen::Vector3d a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  EXPECT_NEAR(closest_point({0.5, 0.5, 3}, a, b, c).distance, 3, 1e-14);
  EXPECT_NEAR(closest_point({1, -2, 0}, a, b, c).distance, 2, 1e-14);
  EXPECT_EQ(closest_point({1, -2, 0}, a, b, c).barycentric[2], 0);
  EXPECT_NEAR(closest_point({-3, -4, 0}, a, b, c).distance, 5, 1e-14);
  EXPECT_NEAR(closest_point({2, 2, 0}, a, b, c).distance, std::sqrt(2.), 1e-14);
}

TEST_F(TwoPatches, AnOpenGapCarriesNothingAndAClosedOneIsReported)
{
  contact.search(with_gap(0.25));
  EXPECT_EQ(contact.n_in_contact(with_gap(0.25)), 0);
  EXPECT_EQ(contact.deepest_penetration(with_gap(0.25)), 0);
  contact.search(with_gap(-0.3));
  EXPECT_GT(contact.n_in_contact(with_gap(-0.3)), 4);
  EXPECT_NEAR(contact.deepest_penetration(with_gap(-0.3)), 0.3, 1e-12);
}

TEST_F(TwoPatches, ForcesOfBothSidesCancel)
{
  Eigen::VectorXd solution = with_gap(0.0) + 0.05 * scattered(n_all, 21);
  contact.search(solution);
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(), upper = lower;
  LocalSystem local;
  for (int item = 0; item < contact.n_items(); ++item)
  {
    contact.evaluate(item, solution, local);
    for (std::size_t i = 0; i < local.unknowns.size(); ++i)
      (local.unknowns[i] < n_lower ? lower : upper)[local.unknowns[i] % 3] +=
          local.residual[static_cast<Eigen::Index>(i)];
  }
  EXPECT_LT((lower + upper).norm(), 1e-13);
  EXPECT_GT(upper.norm(), 0.01);
  // The residual is internal force: it pulls the lower patch up, so the upper is pushed up by the opposite sign.
  EXPECT_LT(upper.z(), 0);
}

TEST_F(TwoPatches, ResidualAndTangentAgreeWithDifferenceQuotients)
{
  const Eigen::VectorXd solution = with_gap(0.05) + 0.05 * scattered(n_all, 22);
  contact.search(solution);
  int n_checked = 0;
  for (int item = 0; item < contact.n_items(); ++item)
  {
    LocalSystem local;
    contact.evaluate(item, solution, local);
    if (local.energy < 1e-6)
      continue;
    ++n_checked;
    EXPECT_LT(residual_error(contact, item, solution, 1e-6), 1e-6);
    EXPECT_LT(tangent_error(contact, item, solution, 1e-6), 1e-6);
  }
  EXPECT_GT(n_checked, 4);
}

TEST_F(TwoPatches, ASecondSearchAtTheSameStateChangesNothing)
{
  const Eigen::VectorXd solution = with_gap(0.0);
  EXPECT_TRUE(contact.search(solution));
  EXPECT_FALSE(contact.search(solution));
  EXPECT_TRUE(contact.update(solution));
  EXPECT_FALSE(contact.update(solution));
}
} // namespace
} // namespace pelvireg::reference_fe
