#include "registration/constraints/contact_memory.h"
#include "registration/solver/constraint_solver.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace pelvireg::registration
{
namespace
{
/// A rigid block of 1 t, 20 x 20 x 10 mm, on four corner contacts; h = 1 s. Rows: normal, along, across at each corner.
struct BlockOnASlope
{
  Eigen::Matrix<double, 12, 12> compliance;
  Eigen::Matrix<double, 12, 1> load_motion;
  static constexpr double gravity = 9810; // mm/s^2

  explicit BlockOnASlope(double angle)
  {
    const Eigen::Vector3d size(20, 20, 10);
    Eigen::Matrix<double, 6, 6> inverse_mass = Eigen::Matrix<double, 6, 6>::Identity(); // translation, rotation
    for (int i = 0; i < 3; ++i)
      inverse_mass(3 + i, 3 + i) = 12 / (size.squaredNorm() - size[i] * size[i]);
    Eigen::Matrix<double, 12, 6> jacobian;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Eigen::Vector3d lever(corner % 2 ? 10 : -10, corner / 2 ? 10 : -10, -5);
      const Eigen::Vector3d axes[3] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
      for (int k = 0; k < 3; ++k)
        jacobian.row(3 * corner + k) << axes[k].transpose(), lever.cross(axes[k]).transpose();
    }
    compliance = jacobian * inverse_mass * jacobian.transpose();
    Eigen::Matrix<double, 6, 1> fall = Eigen::Matrix<double, 6, 1>::Zero();
    fall[0] = gravity * std::sin(angle);
    fall[2] = -gravity * std::cos(angle);
    load_motion = jacobian * fall;
  }
};

std::vector<int> indices(int n)
{
  std::vector<int> result(n);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

ConstraintSolver contacts_of(const Eigen::MatrixXd &compliance, const Eigen::VectorXd &gaps, int n_bilateral,
                             int rows_per_contact, double friction, double row_compliance = 0)
{
  ConstraintSolver solver;
  const int n = static_cast<int>(gaps.size());
  solver.reset(n, n_bilateral, rows_per_contact, friction);
  solver.add_compliance(indices(n), compliance);
  for (int row = 0; row < n; ++row)
    solver.set_row(row, gaps[row], row_compliance);
  return solver;
}
} // namespace

// Four contacts under a rigid block are redundant: their forces are not unique, its motion is.
TEST(Contacts, ABlockOnASlopeSticksBelowTheFrictionAngleAndSlidesAboveIt)
{
  const double mu = 0.3;
  for (const double angle : {0.5 * std::atan(mu), 0.98 * std::atan(mu), 1.02 * std::atan(mu), 1.5 * std::atan(mu)})
  {
    const BlockOnASlope block(angle);
    ConstraintSolver solver = contacts_of(block.compliance, -block.load_motion, 0, 3, mu);
    ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-7, .tolerance_newton = 1e-7, .max_sweeps = 5000}));
    const Eigen::VectorXd motion = block.load_motion + block.compliance * solver.multipliers();
    const double slide = std::max(0.0, BlockOnASlope::gravity * (std::sin(angle) - mu * std::cos(angle)));
    double pressing = 0;
    for (int corner = 0; corner < 4; ++corner)
    {
      EXPECT_NEAR(motion[3 * corner], 0, 1e-4);
      EXPECT_NEAR(motion[3 * corner + 1], slide, 1e-4);
      EXPECT_NEAR(motion[3 * corner + 2], 0, 1e-4);
      pressing += solver.multipliers()[3 * corner];
    }
    EXPECT_NEAR(pressing, BlockOnASlope::gravity * std::cos(angle), 1e-3);
    EXPECT_LE(solver.contact_residual().cone_violation, 1e-10 * pressing);
    EXPECT_LE(solver.contact_residual().motion, 1e-5);
  }
}

// Every one of the 2^n choices of closed contacts is tried; one fulfils the law (S is positive definite).
TEST(Contacts, WithoutFrictionEqualTheCombinationThatFulfilsTheLaw)
{
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round)
  {
    const int n = 7, m = 3; // bilateral first
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const Eigen::MatrixXd compliance = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd gaps = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
    ConstraintSolver solver = contacts_of(compliance, gaps, m, 1, 0);
    ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-12, .tolerance_newton = 1e-12, .max_sweeps = 20000}));
    int n_solutions = 0;
    for (int closed = 0; closed < 1 << (n - m); ++closed)
    {
      std::vector<int> rows = indices(m);
      for (int k = 0; k < n - m; ++k)
        if (closed >> k & 1)
          rows.push_back(m + k);
      Eigen::VectorXd force = Eigen::VectorXd::Zero(n);
      const Eigen::MatrixXd block = compliance(rows, rows);
      const Eigen::VectorXd wanted = gaps(rows);
      const Eigen::VectorXd found = block.llt().solve(wanted);
      force(rows) = found;
      const Eigen::VectorXd open = compliance * force - gaps;
      if (force.tail(n - m).minCoeff() < 0 || open.tail(n - m).minCoeff() < -1e-9)
        continue;
      ++n_solutions;
      EXPECT_LE((solver.multipliers() - force).norm(), 1e-6 * force.norm());
    }
    EXPECT_EQ(n_solutions, 1);
    EXPECT_LE(solver.contact_residual().motion, 1e-10);
    EXPECT_LE(solver.contact_residual().complementarity, 1e-9);
  }
}

// The law is checked row by row, from W and the forces alone.
TEST(Contacts, WithFrictionAndBilateralRowsFulfilCoulombsLaw)
{
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  const double mu = 0.4;
  int n_sticking = 0, n_slipping = 0, n_open = 0;
  for (int round = 0; round < 20; ++round)
  {
    const int m = 4, n_contacts = 5, n = m + 3 * n_contacts;
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const Eigen::MatrixXd compliance = root * root.transpose() / n + Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd gaps = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
    for (int k = 0; k < n_contacts; ++k)
    {
      gaps[m + 3 * k] += 0.7;
      gaps.segment<2>(m + 3 * k + 1) *= 0.4;
    }
    ConstraintSolver solver = contacts_of(compliance, gaps, m, 3, mu);
    ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-12, .tolerance_newton = 1e-12, .max_sweeps = 20000}));
    const Eigen::VectorXd force = solver.multipliers(), motion = compliance * force - gaps;
    EXPECT_LE(motion.head(m).cwiseAbs().maxCoeff(), 1e-8);
    for (int k = 0; k < n_contacts; ++k)
    {
      const int row = m + 3 * k;
      EXPECT_GE(force[row], 0);
      EXPECT_GE(motion[row], -1e-8);
      EXPECT_LE(std::abs(force[row] * motion[row]), 1e-8);
      const Eigen::Vector2d slip = motion.segment<2>(row + 1), held = force.segment<2>(row + 1);
      EXPECT_LE(held.norm(), mu * force[row] + 1e-12);
      if (force[row] == 0)
        ++n_open;
      else if (slip.norm() < 1e-7)
        ++n_sticking;
      else
      {
        ++n_slipping;
        EXPECT_LE((held + mu * force[row] * slip.normalized()).norm(), 1e-6);
      }
    }
  }
  EXPECT_GE(n_sticking, 10);
  EXPECT_GE(n_slipping, 10);
  EXPECT_GE(n_open, 10);
}

TEST(Contacts, RedundantAndAntagonistOnesDoNotBlowUp)
{
  // One contact three times against one bilateral row that wants the opposite: the same unknown of compliance 2 mm/N.
  const Eigen::MatrixXd same = 2 * Eigen::MatrixXd::Ones(4, 4);
  for (const double bilateral_compliance : {0.5, 0.0})
  {
    ConstraintSolver solver = contacts_of(same, Eigen::Vector4d(-1, 1, 1, 1), 1, 1, 0, 1e-3);
    solver.set_row(0, -1, bilateral_compliance);
    ASSERT_TRUE(solver.solve({}));
    const Eigen::VectorXd force = solver.multipliers().head(4);
    EXPECT_TRUE(force.allFinite());
    // They meet where the springs balance: (1 + x) / c_bilateral = (1 - x) / (c / 3), c_contact 1e-3 each.
    const double in_series = bilateral_compliance + 1e-3 / 3;
    EXPECT_NEAR(force.tail(3).sum(), 2 / in_series, 0.25 * 2 / in_series);
  }
  // Two contacts that press a row from both sides by more than there is room.
  Eigen::Matrix2d squeezed;
  squeezed << 2, -2, -2, 2;
  ConstraintSolver solver = contacts_of(squeezed, Eigen::Vector2d(1, 1), 0, 1, 0, 1e-3);
  ASSERT_TRUE(solver.solve({.max_sweeps = 20000}));
  EXPECT_NEAR(solver.multipliers()[0], 1 / 1e-3, 20);
  EXPECT_NEAR(solver.multipliers()[1], 1 / 1e-3, 20);
}

TEST(Contacts, ThatNothingCanMoveCarryNoForce)
{
  Eigen::Matrix2d compliance;
  compliance << 1, 0, 0, 0;
  ConstraintSolver solver = contacts_of(compliance, Eigen::Vector2d(1, 1), 0, 1, 0);
  ASSERT_TRUE(solver.solve({}));
  EXPECT_NEAR(solver.multipliers()[0], 1, 1e-6);
  EXPECT_EQ(solver.multipliers()[1], 0);
}

TEST(Contacts, ReportsWhatIsNotSettledAfterTheLastSweep)
{
  const BlockOnASlope block(0.2);
  ConstraintSolver solver = contacts_of(block.compliance, -block.load_motion, 0, 3, 0.3);
  ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-9, .tolerance_newton = 1e-9, .max_sweeps = 1}));
  EXPECT_EQ(solver.sweeps(), 1);
  EXPECT_GT(solver.contact_residual().motion, 1);
  EXPECT_GT(solver.contact_residual().force, 1);
}

TEST(Contacts, StartedFromTheSolutionNeedOneSweep)
{
  const BlockOnASlope block(0.2);
  const SweepLimits limits{.tolerance_mm = 1e-6, .tolerance_newton = 1e-6, .max_sweeps = 5000};
  ConstraintSolver cold = contacts_of(block.compliance, -block.load_motion, 0, 3, 0.3);
  ASSERT_TRUE(cold.solve(limits));
  EXPECT_GT(cold.sweeps(), 5);
  ConstraintSolver warm = contacts_of(block.compliance, -block.load_motion, 0, 3, 0.3);
  for (int row = 0; row < 12; ++row)
    warm.guess(row, cold.multipliers()[row]);
  ASSERT_TRUE(warm.solve(limits));
  EXPECT_LE(warm.sweeps(), 2);
}

TEST(ContactMemory, RecallsByPairAndCell)
{
  ContactMemory memory;
  memory.remember(0, -7, {1, 0, 0});
  memory.remember(0, 3, {2, 0, 0});
  memory.remember(2, 3, {3, 0, 0});
  EXPECT_EQ(memory.recall(0, 3).x(), 2);
  EXPECT_EQ(memory.recall(2, 3).x(), 3);
  EXPECT_EQ(memory.recall(1, 3).norm(), 0);
  EXPECT_EQ(memory.recall(2, 4).norm(), 0);
  memory.clear();
  EXPECT_EQ(memory.recall(0, 3).norm(), 0);
}
} // namespace pelvireg::registration
