#include "reference_fe/elements/shell_cell.h"
#include "reference_fe/elements/shell_kinematics.h"
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "reference_fe/materials/yeoh.h"
#include "synthetic/dataset/error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pelvireg::reference_fe
{
namespace
{
/// A doubly curved, skewed cell of order p with varying thickness.
struct CurvedCell
{
  ShellReferenceCell reference;
  ShellCell cell;

  explicit CurvedCell(int order)
      : reference(order), cell(reference, geometry(order, 0), geometry(order, 1), thickness(order))
  {
  }

  static Eigen::Matrix2Xd nodes(int order)
  {
    // The nodes are where each shape function is one: read them off the linear functions x and y.
    const ShellReferenceCell cell(order);
    Eigen::Matrix2Xd lattice(2, (order + 1) * (order + 1));
    for (int j = 0; j <= order; ++j)
      for (int i = 0; i <= order; ++i)
      {
        const double gauss_lobatto[4][4] = {
            {0}, {0, 1}, {0, 0.5, 1}, {0, 0.5 - std::sqrt(5) / 10, 0.5 + std::sqrt(5) / 10, 1}};
        const Eigen::Vector2d point(gauss_lobatto[order][i], gauss_lobatto[order][j]);
        Eigen::Index node;
        shape_table(order, point).value.col(0).maxCoeff(&node);
        lattice.col(node) = point;
      }
    return lattice;
  }

  static Eigen::Matrix3Xd geometry(int order, int what)
  {
    const Eigen::Matrix2Xd at = nodes(order);
    Eigen::Matrix3Xd value(3, at.cols());
    for (Eigen::Index k = 0; k < at.cols(); ++k)
    {
      const double x = 3 * at(0, k) + 0.4 * at(1, k), y = 2.5 * at(1, k) - 0.3 * at(0, k);
      if (what == 0)
        value.col(k) = Eigen::Vector3d(x, y, 0.10 * x * x - 0.07 * x * y + 0.05 * y * y);
      else
        value.col(k) = Eigen::Vector3d(-0.2 * x + 0.07 * y, 0.07 * x - 0.1 * y, 1).normalized();
    }
    return value;
  }

  static Eigen::VectorXd thickness(int order)
  {
    return (0.4 + 0.1 * nodes(order).row(0).array() - 0.05 * nodes(order).row(1).array()).transpose();
  }
};

Eigen::VectorXd some_motion(int n_nodes, double size)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-size, size);
  Eigen::VectorXd q(7 * n_nodes);
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = uniform(generator);
  return q;
}

LocalSystem evaluate(const ShellCell &cell, const HyperelasticLaw &law, const Eigen::VectorXd &q,
                     const Eigen::VectorXd *previous = nullptr)
{
  LocalSystem local;
  cell.evaluate(law, q, previous, local);
  return local;
}

class EveryOrder : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(, EveryOrder, ::testing::Values(1, 2, 3));

const Yeoh yeoh(0.1, 0.05, 0.02, 20.0);

TEST_P(EveryOrder, ResidualIsTheDerivativeOfTheEnergy)
{
  const CurvedCell curved(GetParam());
  const Eigen::VectorXd q = some_motion(curved.reference.n_nodes, 0.15);
  const LocalSystem local = evaluate(curved.cell, yeoh, q);
  const double h = 1e-4;
  for (Eigen::Index i = 0; i < q.size(); ++i)
  {
    const auto energy = [&](double step)
    {
      Eigen::VectorXd moved = q;
      moved[i] += step;
      return evaluate(curved.cell, yeoh, moved).energy;
    };
    const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    EXPECT_NEAR(local.residual[i], slope, 2e-9 * local.residual.norm()) << "unknown " << i;
  }
}

TEST_P(EveryOrder, TangentIsTheDerivativeOfTheResidual)
{
  const CurvedCell curved(GetParam());
  const Eigen::VectorXd q = some_motion(curved.reference.n_nodes, 0.15);
  const LocalSystem local = evaluate(curved.cell, yeoh, q);
  const double h = 1e-4;
  for (Eigen::Index i = 0; i < q.size(); ++i)
  {
    const auto residual = [&](double step) -> Eigen::VectorXd
    {
      Eigen::VectorXd moved = q;
      moved[i] += step;
      return evaluate(curved.cell, yeoh, moved).residual;
    };
    const Eigen::VectorXd column = (8 * (residual(h) - residual(-h)) - (residual(2 * h) - residual(-2 * h))) / (12 * h);
    EXPECT_LT((local.tangent.col(i) - column).norm(), 2e-9 * local.tangent.norm()) << "unknown " << i;
  }
}

/// The unknowns of a rigid motion x -> Q x + t of the cell.
Eigen::VectorXd rigid_motion(int order, const Eigen::Matrix3d &rotation, const Eigen::Vector3d &shift)
{
  const Eigen::Matrix3Xd r = CurvedCell::geometry(order, 0), d = CurvedCell::geometry(order, 1);
  const Eigen::Matrix3Xd u = (rotation * r - r).colwise() + shift, w = rotation * d - d;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(7 * r.cols());
  q.head(3 * r.cols()) = u.reshaped();
  q.segment(3 * r.cols(), 3 * r.cols()) = w.reshaped();
  return q;
}

TEST_P(EveryOrder, LargeRigidMotionCostsNothing)
{
  const CurvedCell curved(GetParam());
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2.3, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const LocalSystem local = evaluate(curved.cell, yeoh, rigid_motion(GetParam(), rotation, {5, -3, 2}));
  EXPECT_LT(std::abs(local.energy), 1e-14 * curved.cell.volume());
  EXPECT_LT(local.residual.norm(), 1e-12);
}

TEST_P(EveryOrder, RestTangentHasSixZeroEnergyModesAndNoMore)
{
  const CurvedCell curved(GetParam());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7 * curved.reference.n_nodes);
  const LocalSystem local = evaluate(curved.cell, SaintVenantKirchhoff(2, 0.3), rest);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(local.tangent).eigenvalues();
  const double largest = eigenvalues.maxCoeff();
  EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-12 * largest);
  EXPECT_GT(eigenvalues[6], 1e-8 * largest);
}

TEST(ShellCell, TangentIsSymmetricAndMixedPointsChangeItOnlyAwayFromTheSolution)
{
  const CurvedCell curved(2);
  const Eigen::VectorXd q = some_motion(9, 0.1), previous = some_motion(9, 0.05);
  const LocalSystem plain = evaluate(curved.cell, yeoh, q);
  const LocalSystem same = evaluate(curved.cell, yeoh, q, &q), mixed = evaluate(curved.cell, yeoh, q, &previous);
  EXPECT_LT((plain.tangent - plain.tangent.transpose()).norm(), 1e-13 * plain.tangent.norm());
  EXPECT_LT((plain.tangent - same.tangent).norm(), 1e-14 * plain.tangent.norm());
  EXPECT_GT((plain.tangent - mixed.tangent).norm(), 1e-4 * plain.tangent.norm());
  EXPECT_EQ(plain.residual, mixed.residual);
}

TEST(ShellCell, HomogeneousStretchOfAFlatCellGivesTheEnergyOfTheLaw)
{
  const ShellReferenceCell reference(2);
  Eigen::Matrix3Xd r = Eigen::Matrix3Xd::Zero(3, 9), n = Eigen::Matrix3Xd::Zero(3, 9);
  r.topRows<2>() = CurvedCell::nodes(2) * 4;
  n.row(2).setOnes();
  const ShellCell cell(reference, r, n, Eigen::VectorXd::Constant(9, 0.5));
  EXPECT_NEAR(cell.volume(), 16, 1e-12);
  const Eigen::Vector3d stretch(1.2, 0.9, 0.95);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(63);
  q.head<27>() = (((stretch.array() - 1).matrix().asDiagonal() * r).eval()).reshaped();
  q.segment<27>(27) = (((stretch.array() - 1).matrix().asDiagonal() * n).eval()).reshaped();
  Voigt strain = Voigt::Zero();
  strain.head<3>() = 0.5 * (stretch.array().square() - 1);
  EXPECT_NEAR(evaluate(cell, yeoh, q).energy, 16 * yeoh.evaluate(strain).energy, 1e-13);
  EXPECT_NEAR(cell.smallest_jacobian(q), stretch.prod(), 1e-13);
}

TEST(ShellCell, WallThickerThanTheRadiusIsRefused)
{
  const ShellReferenceCell reference(2);
  EXPECT_THROW(
      ShellCell(reference, CurvedCell::geometry(2, 0), -CurvedCell::geometry(2, 1), Eigen::VectorXd::Constant(9, 0.5)),
      InputError);
}

TEST(ShellKinematics, GradientAndHessianAreTheDerivativesOfThePoint)
{
  const ShellNode node{{1, 2, 3}, Eigen::Vector3d(0.6, 0, 0.8), 0.7};
  const ShellNodeUnknowns q = (ShellNodeUnknowns() << 0.1, -0.2, 0.3, 0.05, 0.1, -0.15, 0.2).finished();
  const Eigen::Vector3d force(0.3, -1, 2);
  const double h = 1e-5;
  for (const double zeta : {-1.0, 1.0})
    for (int i = 0; i < 7; ++i)
    {
      ShellNodeUnknowns plus = q, minus = q;
      plus[i] += h;
      minus[i] -= h;
      const Eigen::Vector3d slope = (shell_point(node, plus, zeta) - shell_point(node, minus, zeta)) / (2 * h);
      EXPECT_LT((shell_point_gradient(node, q, zeta).col(i) - slope).norm(), 1e-9);
      const ShellNodeUnknowns column =
          (shell_point_gradient(node, plus, zeta) - shell_point_gradient(node, minus, zeta)).transpose() * force /
          (2 * h);
      EXPECT_LT((shell_point_hessian(node, zeta, force).col(i) - column).norm(), 1e-9);
    }
}
} // namespace
} // namespace pelvireg::reference_fe
