#include "reference_fe/contact/closest_point.h"
#include "reference_fe/contact/contact_law.h"
#include "reference_fe/contact/face_projection.h"
#include "reference_fe/contact/facet_tree.h"
#include "reference_fe/contact/penalty_contact.h"
#include "tests/unit/reference_fe/terms/difference_quotients.h"

#include <Eigen/Geometry>

namespace pelvireg::reference_fe
{
namespace
{
/// A flat patch of n x n faces, of side 4, at height z; facing up or down.
ContactFaces patch(int n, double z, bool up, int first_unknown)
{
  const auto node = [&](int i, int j)
  {
    SurfaceNode made;
    made.first_unknown = first_unknown + 3 * (j * (2 * n + 1) + i);
    made.rest = {2. * i / n, 2. * j / n, z};
    return made;
  };
  ContactFaces surface;
  for (int j = 0; j < 2 * n; j += 2)
    for (int i = 0; i < 2 * n; i += 2)
    {
      std::vector<SurfaceNode> nodes;
      for (int k = 0; k < 9; ++k)
      {
        const Eigen::Vector2d at = face_node_coordinates(9, k);
        const int right = 1 + static_cast<int>(up ? at.x() : at.y()), back = 1 + static_cast<int>(up ? at.y() : at.x());
        nodes.push_back(node(i + right, j + back));
      }
      surface.faces.push_back({nodes});
    }
  return surface;
}

class TwoPatches : public ::testing::Test
{
protected:
  static constexpr int n_lower = 3 * 81, n_all = n_lower + 3 * 49;
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
  const double onset = 0.2, stiffening = 30;
  const auto law = [&](double gap) { return contact_law(gap, onset, stiffening); };
  for (const double border : {-onset, 0., onset})
  {
    EXPECT_NEAR(law(border - 1e-12).energy, law(border + 1e-12).energy, 1e-11);
    EXPECT_NEAR(law(border - 1e-12).d_energy, law(border + 1e-12).d_energy, 1e-10);
    EXPECT_NEAR(law(border - 1e-12).d2_energy, law(border + 1e-12).d2_energy, 1e-9);
  }
  for (const double gap : {-0.5, -0.1, 0.05, 0.3})
  {
    const double step = 1e-6;
    EXPECT_NEAR(law(gap).d_energy, (law(gap + step).energy - law(gap - step).energy) / (2 * step), 1e-9);
    EXPECT_NEAR(law(gap).d2_energy, (law(gap + step).d_energy - law(gap - step).d_energy) / (2 * step), 1e-8);
  }
}

/// A curved face of 9 or 6 nodes and a point beside it, on a small face of its own.
struct CurvedFaces
{
  Eigen::Matrix3Xd own, other;
  Eigen::VectorXd shape;

  explicit CurvedFaces(int n) : own(3, 6), other(3, n), shape(surface_shapes(6, {0.2, 0.3}).col(0))
  {
    for (int k = 0; k < n; ++k)
    {
      const Eigen::Vector2d at = 3 * face_node_coordinates(n, k);
      other.col(k) << at, 0.06 * at.squaredNorm() + 0.05 * at.x() * at.y();
    }
    other += 0.1 * Eigen::Map<const Eigen::Matrix3Xd>(scattered(3 * n, 5).eval().data(), 3, n);
    for (int k = 0; k < 6; ++k)
      own.col(k) << 1 + face_node_coordinates(6, k).x(), 0.6 + face_node_coordinates(6, k).y(), 0.5;
    own += 0.1 * Eigen::Map<const Eigen::Matrix3Xd>(scattered(18, 6).eval().data(), 3, 6);
  }
  FaceProjection projection() const { return project(other, own * shape, {0.3, 0.3}); }
  double &coordinate(int i) { return i < own.size() ? own.data()[i] : other.data()[i - own.size()]; }
};

class FaceGap : public ::testing::TestWithParam<int>
{
};

TEST_P(FaceGap, GradientAndHessianAgreeWithDifferenceQuotientsAndActionEqualsReaction)
{
  CurvedFaces faces(GetParam());
  const FaceProjection at = faces.projection();
  ASSERT_TRUE(at.converged);
  EXPECT_LT((at.tangents.transpose() * (faces.own * faces.shape - faces.other * at.shapes.col(0))).norm(), 1e-12);
  const GapDerivatives d = gap_derivatives(at, faces.shape);
  const Eigen::MatrixXd hessian = d.basis * d.coupling * d.basis.transpose();
  const double step = 1e-5;
  for (int i = 0; i < static_cast<int>(d.gradient.size()); ++i)
  {
    CurvedFaces plus = faces, minus = faces;
    plus.coordinate(i) += step;
    minus.coordinate(i) -= step;
    const FaceProjection up = plus.projection(), down = minus.projection();
    EXPECT_NEAR(d.gradient[i], (up.gap - down.gap) / (2 * step), 1e-9);
    const Eigen::VectorXd quotient =
        (gap_derivatives(up, faces.shape).gradient - gap_derivatives(down, faces.shape).gradient) / (2 * step);
    EXPECT_LT((hessian.col(i) - quotient).cwiseAbs().maxCoeff(), 1e-8);
  }
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  for (int k = 0; k < static_cast<int>(d.gradient.size()) / 3; ++k)
  {
    const Eigen::Vector3d x = k < 6 ? faces.own.col(k) : faces.other.col(k - 6), f = d.gradient.segment<3>(3 * k);
    force += f;
    moment += x.cross(f);
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(SquareAndTriangle, FaceGap, ::testing::Values(9, 6));

TEST(FacetTree, FindsWhatASearchOfAllBoxesFinds)
{
  const int n = 200;
  const Eigen::VectorXd at = 10 * scattered(9 * n, 7);
  Eigen::Matrix3Xd points(3, 3 * n);
  std::vector<std::array<int, 3>> facets;
  for (int f = 0; f < n; ++f)
  {
    for (int k = 0; k < 3; ++k)
      points.col(3 * f + k) = at.segment<3>(9 * f) + 0.3 * at.segment<3>(9 * f + 3 * k);
    facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  const FacetTree tree(points, facets);
  std::vector<int> found;
  for (int q = 0; q < 20; ++q)
  {
    const Eigen::Vector3d point = at.segment<3>(3 * q) + Eigen::Vector3d(1, 0, 0);
    std::vector<int> expected;
    for (int f = 0; f < n; ++f)
    {
      Eigen::AlignedBox3d box;
      for (int k = 0; k < 3; ++k)
        box.extend(points.col(3 * f + k));
      if (box.squaredExteriorDistance(point) <= 4)
        expected.push_back(f);
    }
    tree.candidates(point, 2, found);
    EXPECT_EQ(found, expected);
  }
  tree.candidates({1000, 0, 0}, 2, found);
  EXPECT_TRUE(found.empty());
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
  EXPECT_EQ(contact.deepest_penetration(with_gap(0.25)).depth, 0);
  contact.search(with_gap(-0.3));
  EXPECT_GT(contact.n_in_contact(with_gap(-0.3)), 4);
  EXPECT_NEAR(contact.deepest_penetration(with_gap(-0.3)).depth, 0.3, 1e-12);
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
