#include "registration/solver/body_solver.h"
#include "registration/solver/body_threads.h"
#include "registration/solver/constraint_solver.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <atomic>

namespace pelvireg::registration
{
namespace
{
Eigen::MatrixXd dense(const SymmetricBlockMatrix &matrix)
{
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.n_rows(), matrix.n_rows());
  for (int c = 0; c < matrix.n_blocks(); ++c)
    for (int k = matrix.block_starts()[c]; k < matrix.block_starts()[c + 1]; ++k)
      result.block<3, 3>(3 * matrix.block_rows()[k], 3 * c) =
          Eigen::Map<const Eigen::Matrix3d>(matrix.values() + SymmetricBlockMatrix::block_size * k);
  return result.selfadjointView<Eigen::Lower>();
}

struct Fixture
{
  Body body = scene::hollow_ellipsoid({20, 30, 25}, 3, 2);
  Fixture() { body.fixed_nodes = {3, 4, 170}; }
  BodySolver make() const
  {
    BodySolver solver(body, 0.02);
    Points moved = body.rest_positions.unaryExpr([](double x) { return x + std::sin(x / 5); });
    for (const int node : body.fixed_nodes)
      moved.row(node) = body.rest_positions.row(node);
    solver.set_positions(moved);
    solver.assemble();
    return solver;
  }
};

/// Rows with 1 to 3 nodes each; some touch fixed nodes.
ConstraintRows some_rows(int n)
{
  ConstraintRows rows;
  for (int k = 0; k < n; ++k)
  {
    rows.add_row(RowKind::sliding, 0.1 * k, 0);
    for (int i = 0; i <= k % 3; ++i)
      rows.add_entry({0, (11 * k + 29 * i) % 300, Eigen::Vector3d(1, -0.5 * i, 0.1 * k)});
  }
  return rows;
}
} // namespace

TEST(BodySolver, FreeMotionSolvesTheDenseSystem)
{
  BodySolver solver = Fixture().make();
  ASSERT_TRUE(solver.factorise());
  solver.predict_free_motion();
  solver.gather_rows(ConstraintRows(), 0);
  ASSERT_TRUE(solver.correct(Eigen::VectorXd()));
  const Eigen::VectorXd expected = dense(solver.matrix()).llt().solve(solver.load());
  const Points motion = solver.corrected_positions() - solver.positions();
  for (int node = 0; node < motion.rows(); ++node)
    if (const int first = solver.first_unknown(node); first >= 0)
      EXPECT_LE((motion.row(node).transpose() - expected.segment<3>(first)).norm(), 1e-9);
    else
      EXPECT_EQ(motion.row(node).norm(), 0);
}

TEST(BodySolver, MatrixIsTheDifferenceOfTheLoadAtRest)
{
  Body body = scene::hollow_ellipsoid({20, 30, 25}, 3, 1);
  BodySolver solver(body, 1e9); // no inertia
  solver.assemble();
  const Eigen::MatrixXd matrix = dense(solver.matrix());
  constexpr double step = 1e-5;
  for (const int node : {0, 17, 60})
    for (int axis = 0; axis < 3; ++axis)
    {
      Eigen::VectorXd load[2];
      for (const int side : {0, 1})
      {
        Points moved = body.rest_positions;
        moved(node, axis) += side == 0 ? -step : step;
        solver.set_positions(moved);
        solver.assemble();
        load[side] = solver.load();
      }
      const Eigen::VectorXd slope = (load[1] - load[0]) / (2 * step);
      EXPECT_LE((slope + matrix.col(solver.first_unknown(node) + axis)).norm(), 1e-7 * matrix.norm());
    }
}

TEST(Compliance, EqualsTheDenseSchurComplement)
{
  BodySolver solver = Fixture().make();
  ASSERT_TRUE(solver.factorise());
  const ConstraintRows rows = some_rows(60);
  solver.gather_rows(rows, 0);
  solver.compute_compliance();
  const int n = static_cast<int>(solver.touching_rows().size());
  EXPECT_GE(n, 55);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n, solver.n_unknowns());
  for (int k = 0; k < n; ++k)
    for (const RowEntry *e = rows.begin(solver.touching_rows()[k]); e != rows.end(solver.touching_rows()[k]); ++e)
      if (const int first = solver.first_unknown(e->node); first >= 0)
        h.row(k).segment<3>(first) += e->jacobian.transpose();
  const Eigen::MatrixXd expected = h * dense(solver.matrix()).llt().solve(h.transpose());
  const Eigen::MatrixXd difference = (solver.compliance() - expected).triangularView<Eigen::Lower>();
  EXPECT_LE(difference.norm(), 1e-11 * expected.norm());
}

TEST(SupernodalFactor, RefusesAMatrixThatIsNotPositiveDefinite)
{
  SymmetricBlockMatrix matrix(2, {{0, 1}});
  matrix.add_to_diagonal(0, 1);
  matrix.add_to_diagonal(1, -1);
  SupernodalFactor factor(matrix);
  EXPECT_FALSE(factor.factorise(matrix));
  matrix.add_to_diagonal(1, 2);
  EXPECT_TRUE(factor.factorise(matrix));
}

TEST(ConstraintSolver, ClosesIndependentRows)
{
  ConstraintSolver solver;
  solver.reset(2);
  solver.add_compliance({0, 1}, (Eigen::Matrix2d() << 2, 0, 1, 3).finished());
  solver.set_row(0, 1, 0);
  solver.set_row(1, -2, 0.5);
  ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-12, .max_sweeps = 10}));
  const Eigen::Vector2d expected = (Eigen::Matrix2d() << 2, 1, 1, 3.5).finished().inverse() * Eigen::Vector2d(1, -2);
  EXPECT_LE((solver.multipliers() - expected).norm(), 1e-9); // the least compliance, 1e-10 of W
}

TEST(ConstraintSolver, SharesTheGapAmongAntagonistRows)
{
  ConstraintSolver solver;
  solver.reset(3);
  solver.add_compliance({0, 1, 2}, Eigen::Matrix3d::Ones()); // one row three times
  solver.set_row(0, 1, 0);
  solver.set_row(1, -1, 0);
  solver.set_row(2, 0.3, 0);
  ASSERT_TRUE(solver.solve({.tolerance_mm = 1e-6, .max_sweeps = 50}));
  EXPECT_TRUE(solver.multipliers().allFinite());
  EXPECT_NEAR(solver.multipliers().sum(), 0.1,
              1e-5); // round-off of 1e10 N; the motion is the mean of the three demands
}

TEST(ConstraintSolver, ReportsASystemThatIsNotFinite)
{
  ConstraintSolver solver;
  solver.reset(1);
  solver.add_compliance({0}, Eigen::MatrixXd::Constant(1, 1, std::nan("")));
  solver.set_row(0, 1, 0);
  EXPECT_FALSE(solver.solve({.tolerance_mm = 1e-6, .max_sweeps = 5}));
}

TEST(BodyThreads, RunsEveryBodyOnce)
{
  for (const int n_threads : {1, 2, 5})
  {
    BodyThreads threads(n_threads);
    for (int round = 0; round < 200; ++round)
    {
      std::vector<std::atomic<int>> calls(7);
      threads.run({6, 5, 4, 3, 2, 1, 0}, [&](int body) { ++calls[body]; });
      for (const std::atomic<int> &n : calls)
        EXPECT_EQ(n, 1);
    }
  }
}
} // namespace pelvireg::registration
