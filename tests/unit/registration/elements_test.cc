#include "registration/elements/hexahedron.h"
#include "registration/elements/rotation.h"
#include "registration/elements/tetrahedron.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace pelvireg::registration
{
namespace
{
std::mt19937 generator()
{
  return std::mt19937(7);
}

Eigen::Matrix3d random_matrix(std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::Matrix3d::NullaryExpr([&] { return uniform(random); });
}

Eigen::Matrix3d random_rotation(std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
      .normalized()
      .toRotationMatrix();
}

/// A tetrahedron as an extruded wall has it, and a hexahedron with no two faces parallel.
template <class Element> typename Element::NodalVectors rest_shape();
template <> Tetrahedron::NodalVectors rest_shape<Tetrahedron>()
{
  Tetrahedron::NodalVectors rest;
  rest << 0, 8, 1, 2, 0, 0.5, 7, 2, 0, 0.2, 0.1, 3;
  return rest;
}
template <> Hexahedron::NodalVectors rest_shape<Hexahedron>()
{
  Hexahedron::NodalVectors rest;
  rest << 0, 4, 4.4, 0.2, 0.1, 4.2, 4.1, -0.3, //
      0, 0.3, 3, 3.3, 0.2, -0.1, 3.2, 2.9,     //
      0, 0.1, -0.2, 0.2, 2, 2.2, 2.1, 1.8;
  return rest;
}

template <class Element> class ElementTest : public testing::Test
{
};
using Elements = testing::Types<Tetrahedron, Hexahedron>;
TYPED_TEST_SUITE(ElementTest, Elements);

const Lame material = lame_constants(0.6, 0.45);
} // namespace

TEST(Rotation, AgreesWithSignedSvdOnAMillionRandomMatrices)
{
  std::mt19937 random = generator();
  double worst = 0;
  for (int i = 0; i < 1'000'000; ++i)
  {
    const Eigen::Matrix3d f = random_matrix(random);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0)
      u.col(2) = -u.col(2);
    const Eigen::Matrix3d expected = u * svd.matrixV().transpose();
    const Eigen::Matrix3d q = rotation_of(f);
    // Condition of the polar factor: 2 / (sigma_2 + sigma_3) with the sign (Higham, Functions of Matrices, 8.2).
    const Eigen::Vector3d stretches =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(expected.transpose() * f).eigenvalues();
    const double gap = stretches[0] + stretches[1];
    worst = std::max(worst, (q - expected).norm() * gap);
  }
  EXPECT_LE(worst, 1e-13);
}

TEST(Rotation, IsProperForFlatInvertedAndZeroGradients)
{
  const std::array<Eigen::Matrix3d, 5> gradients{
      Eigen::Vector3d(1, 1, -0.2).asDiagonal().toDenseMatrix(), Eigen::Vector3d(1, 1, 0).asDiagonal().toDenseMatrix(),
      Eigen::Vector3d(1, 0, 0).asDiagonal().toDenseMatrix(), Eigen::Matrix3d::Zero(), -Eigen::Matrix3d::Identity()};
  for (const Eigen::Matrix3d &f : gradients)
  {
    const Eigen::Matrix3d q = rotation_of(f);
    EXPECT_NEAR(q.determinant(), 1, 1e-12);
    EXPECT_LE((q.transpose() * q - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
  EXPECT_LE((rotation_of(gradients[0]) - Eigen::Matrix3d::Identity()).norm(), 1e-12); // the least stretch is flipped
}

TYPED_TEST(ElementTest, DoesNotRotateUnderAPureStretch)
{
  const auto rest = rest_shape<TypeParam>();
  const TypeParam element(rest, material);
  std::mt19937 random = generator();
  for (const double stretch : {1.05, 1.1, 1.2, 1.5})
  {
    const Eigen::Matrix3d axes = random_rotation(random);
    const Eigen::Vector3d principal(stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch));
    const Eigen::Matrix3d f = axes * principal.asDiagonal() * axes.transpose();
    EXPECT_LE((element.rotation(f * rest) - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  }
}

TYPED_TEST(ElementTest, GivesNoForceUnderARigidMotion)
{
  const auto rest = rest_shape<TypeParam>();
  const TypeParam element(rest, material);
  std::mt19937 random = generator();
  const Eigen::Matrix3d q = random_rotation(random);
  const typename TypeParam::NodalVectors moved = (q * rest).colwise() + Eigen::Vector3d(30, -20, 50);
  const Eigen::Matrix3d rotation = element.rotation(moved);
  EXPECT_LE((rotation - q).norm(), 1e-13);
  EXPECT_LE(element.force(rotation, moved).norm(), 1e-11); // E L x round-off of 50 mm
}

TYPED_TEST(ElementTest, TurnsItsForceWithTheBody)
{
  const auto rest = rest_shape<TypeParam>();
  const TypeParam element(rest, material);
  std::mt19937 random = generator();
  const typename TypeParam::NodalVectors bent = rest + 0.3 * TypeParam::NodalVectors::Random();
  const Eigen::Matrix3d q = random_rotation(random);
  const auto force = element.force(element.rotation(bent), bent);
  const typename TypeParam::NodalVectors turned = q * bent;
  EXPECT_LE((element.force(element.rotation(turned), turned) - q * force).norm(), 1e-11);
  EXPECT_GT(force.norm(), 0.1);
}

TYPED_TEST(ElementTest, BalancesForceAndMoment)
{
  const auto rest = rest_shape<TypeParam>();
  const TypeParam element(rest, material);
  const typename TypeParam::NodalVectors bent = rest + 0.5 * TypeParam::NodalVectors::Random();
  const auto force = element.force(element.rotation(bent), bent);
  EXPECT_LE(force.rowwise().sum().norm(), 1e-12 * force.norm() * TypeParam::n_nodes);
  if constexpr (std::is_same_v<TypeParam, Tetrahedron>)
  {
    // Q(F) of a constant gradient makes the stress symmetric: no moment. (A hexahedron's rotation is its centre's
    // only.)
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (int a = 0; a < TypeParam::n_nodes; ++a)
      moment += bent.col(a).cross(force.col(a));
    EXPECT_LE(moment.norm(), 1e-11 * force.norm());
  }
}

TYPED_TEST(ElementTest, HasTheStiffnessThatDifferencesOfItsForceGive)
{
  const auto rest = rest_shape<TypeParam>();
  const TypeParam element(rest, material);
  std::mt19937 random = generator();
  const Eigen::Matrix3d q = random_rotation(random);
  const typename TypeParam::NodalVectors x = q * rest; // no stress: the turning of Q(F) adds nothing to the tangent
  const auto turned = element.rotated_stiffness(element.rotation(x));
  constexpr double step = 1e-5; // mm; central differences: error of order step^2 against shapes of 3 mm
  for (int b = 0; b < TypeParam::n_nodes; ++b)
    for (int axis = 0; axis < 3; ++axis)
    {
      typename TypeParam::NodalVectors plus = x, minus = x;
      plus(axis, b) += step;
      minus(axis, b) -= step;
      const typename TypeParam::NodalVectors slope =
          (element.force(element.rotation(plus), plus) - element.force(element.rotation(minus), minus)) / (2 * step);
      for (int a = 0; a < TypeParam::n_nodes; ++a)
        EXPECT_LE((element.stiffness_block(turned, a, b).col(axis) - slope.col(a)).norm(), 1e-8);
    }
}

TEST(Tetrahedron, IsIndifferentToTheNumberingOfItsNodes)
{
  const auto rest = rest_shape<Tetrahedron>();
  const Tetrahedron::NodalVectors bent = rest + Tetrahedron::NodalVectors::Random();
  const Tetrahedron element(rest, material);
  const Eigen::Matrix3d rotation = element.rotation(bent);
  const auto force = element.force(rotation, bent);
  for (const std::array<int, 4> &order :
       {std::array{1, 2, 0, 3}, std::array{0, 2, 3, 1}, std::array{3, 2, 1, 0}, std::array{1, 0, 3, 2}})
  {
    Tetrahedron::NodalVectors rest_2, bent_2, force_1;
    for (int a = 0; a < 4; ++a)
    {
      rest_2.col(a) = rest.col(order[a]);
      bent_2.col(a) = bent.col(order[a]);
      force_1.col(a) = force.col(order[a]);
    }
    const Tetrahedron renumbered(rest_2, material);
    const Eigen::Matrix3d rotation_2 = renumbered.rotation(bent_2);
    EXPECT_LE((rotation_2 - rotation).norm(), 1e-12);
    EXPECT_LE((renumbered.force(rotation_2, bent_2) - force_1).norm(), 1e-11 * force.norm());
  }
}

TEST(Hexahedron, IsIndifferentToTheNumberingOfItsNodes)
{
  const auto rest = rest_shape<Hexahedron>();
  const Hexahedron::NodalVectors bent = rest + 0.3 * Hexahedron::NodalVectors::Random();
  const Hexahedron element(rest, material);
  const Eigen::Matrix3d rotation = element.rotation(bent);
  const auto force = element.force(rotation, bent);
  // A quarter turn of the reference cube about z and one about x: together they make all 24 orders.
  for (const std::array<int, 8> &order : {std::array{1, 2, 3, 0, 5, 6, 7, 4}, std::array{3, 2, 6, 7, 0, 1, 5, 4}})
  {
    Hexahedron::NodalVectors rest_2, bent_2, force_1;
    for (int a = 0; a < 8; ++a)
    {
      rest_2.col(a) = rest.col(order[a]);
      bent_2.col(a) = bent.col(order[a]);
      force_1.col(a) = force.col(order[a]);
    }
    ASSERT_GT(Hexahedron::least_jacobian(rest_2), 0);
    const Hexahedron renumbered(rest_2, material);
    const Eigen::Matrix3d rotation_2 = renumbered.rotation(bent_2);
    EXPECT_LE((rotation_2 - rotation).norm(), 1e-12);
    EXPECT_LE((renumbered.force(rotation_2, bent_2) - force_1).norm(), 1e-11 * force.norm());
  }
}

TEST(Hexahedron, HasSixRigidModesAndNoOtherFreeOne)
{
  const Hexahedron element(rest_shape<Hexahedron>(), material);
  const Eigen::SelfAdjointEigenSolver<Hexahedron::Stiffness> solver(element.stiffness());
  const auto values = solver.eigenvalues();
  EXPECT_LE(std::abs(values[5]), 1e-10 * values[23]);
  EXPECT_GT(values[6], 1e-3 * values[23] / 10); // the condensed modes soften bending, and must not free it
}

TEST(Hexahedron, SharesItsVolumeOverTheNodes)
{
  Hexahedron::NodalVectors box;
  box << 0, 2, 2, 0, 0, 2, 2, 0, 0, 0, 3, 3, 0, 0, 3, 3, 0, 0, 0, 0, 5, 5, 5, 5;
  const Hexahedron element(box, material);
  EXPECT_NEAR(element.volume(), 30, 1e-12);
  EXPECT_NEAR(element.volume_share(0), 30.0 / 8, 1e-12);
}

// Turned a little, an element 2 % taut is drawn back by its tension alone: sigma V a unit of rotation.
TEST(Hexahedron, TensionHoldsATautElementInItsLine)
{
  const Hexahedron::NodalVectors rest = rest_shape<Hexahedron>();
  const Hexahedron element(rest, material);
  std::mt19937 random = generator();
  const Eigen::Matrix3d axes = random_rotation(random);
  for (const double strain : {0.02, -0.02})
  {
    const Eigen::Vector3d principal(1 + strain, 1 - 0.45 * strain, 1 - 0.45 * strain);
    const Hexahedron::NodalVectors taut = axes * principal.asDiagonal() * axes.transpose() * rest;
    const Eigen::Matrix3d rotation = element.rotation(taut);
    Eigen::Matrix3d turn = axes.col(0) * axes.col(1).transpose();
    turn = (turn - turn.transpose()).eval();
    const Hexahedron::NodalVectors motion = turn * taut;
    const auto force_at = [&](double t)
    {
      const Hexahedron::NodalVectors moved = taut + t * motion;
      return element.force(element.rotation(moved), moved);
    };
    const double drawn_back = ((force_at(1e-4) - force_at(-1e-4)) / 2e-4).cwiseProduct(motion).sum();
    double fixed_rotation = 0, tension = 0;
    const auto tension_stiffness = element.tension_stiffness(rotation, taut);
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
      {
        fixed_rotation += motion.col(a).dot(element.stiffness_block(rotation, a, b) * motion.col(b));
        tension += tension_stiffness(a, b) * motion.col(a).dot(motion.col(b));
      }
    const double expected = 0.6 * strain * element.volume(); // E e V
    EXPECT_NEAR(drawn_back / expected, 1, 0.05);
    EXPECT_LE(fixed_rotation, 0.05 * std::abs(expected));
    EXPECT_NEAR(tension / std::abs(expected), strain > 0 ? 1 : 0, 0.05);
  }
}
} // namespace pelvireg::registration
