// Every instruction set that this processor has, against dense linear algebra and the elements one by one.
#include "registration/elements/rotation.h"
#include "registration/kernels/kernels.h"
#include "registration/solver/compliance.h"
#include "registration/solver/supernodal_factor.h"
#include "registration/solver/tetrahedron_assembly.h"
#include "tests/unit/registration/scene.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

namespace pelvireg::registration
{
namespace
{
const kernels::Kernels &kernels_of(int index)
{
  return kernels::available(index);
}

Eigen::MatrixXd dense(const SymmetricBlockMatrix &matrix)
{
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.n_rows(), matrix.n_rows());
  for (int c = 0; c < matrix.n_blocks(); ++c)
    for (int k = matrix.block_starts()[c]; k < matrix.block_starts()[c + 1]; ++k)
      result.block<3, 3>(3 * matrix.block_rows()[k], 3 * c) =
          Eigen::Map<const Eigen::Matrix3d>(matrix.values() + SymmetricBlockMatrix::block_size * k);
  return result.selfadjointView<Eigen::Lower>();
}

/// A random positive definite matrix over a fill-reducing order of the cliques; the pattern of a body without cliques
/// in common falls into several trees.
SymmetricBlockMatrix random_matrix(int n_blocks, std::vector<std::vector<int>> cliques, std::mt19937 &random)
{
  const std::vector<int> order = fill_reducing_order(n_blocks, cliques);
  std::vector<int> rank(n_blocks);
  for (int k = 0; k < n_blocks; ++k)
    rank[order[k]] = k;
  for (std::vector<int> &clique : cliques)
    for (int &index : clique)
      index = rank[index];
  SymmetricBlockMatrix matrix(n_blocks, cliques);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t k = 0; k < matrix.block_rows().size(); ++k)
    matrix.add(static_cast<int>(k), Eigen::Matrix3d::NullaryExpr([&] { return uniform(random); }));
  for (int column = 0; column < n_blocks; ++column)
    matrix.add_to_diagonal(column, 60); // more than the sum of any row of these patterns
  return matrix;
}

/// Grids, so that supernodes of all sizes and shapes occur; the last one falls into two trees.
std::vector<std::pair<int, std::vector<std::vector<int>>>> patterns()
{
  std::vector<std::pair<int, std::vector<std::vector<int>>>> result = {
      {1, {}}, {2, {{0, 1}}}, {7, {{0, 1, 2, 3, 4, 5, 6}}}};
  for (const int n : {3, 8, 13})
  {
    std::vector<std::vector<int>> cells;
    for (int i = 0; i + 1 < n; ++i)
      for (int j = 0; j + 1 < n; ++j)
        cells.push_back({n * i + j, n * i + j + 1, n * (i + 1) + j, n * (i + 1) + j + 1});
    result.emplace_back(n * n, cells);
  }
  result.push_back(result.back());
  auto &[n_blocks, cells] = result.back();
  const std::size_t n_cells = cells.size();
  for (std::size_t k = 0; k < n_cells; ++k)
  {
    std::vector<int> shifted = cells[k];
    for (int &index : shifted)
      index += n_blocks;
    cells.push_back(shifted);
  }
  n_blocks *= 2;
  return result;
}

class KernelsTest : public testing::TestWithParam<int>
{
};
} // namespace

TEST_P(KernelsTest, FactoriseAndSolveAsDenseCholeskyDoes)
{
  std::mt19937 random(11);
  for (const auto &[n_blocks, cliques] : patterns())
  {
    const SymmetricBlockMatrix matrix = random_matrix(n_blocks, cliques, random);
    SupernodalFactor factor(matrix, kernels_of(GetParam()));
    for (int repeat = 0; repeat < 2; ++repeat) // the second time over what the first one left
      ASSERT_TRUE(factor.factorise(matrix));
    const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(matrix.n_rows(), -1, 2);
    Eigen::VectorXd solution = right_side;
    factor.solve(solution);
    const Eigen::VectorXd expected = dense(matrix).llt().solve(right_side);
    EXPECT_LE((solution - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST_P(KernelsTest, RefuseAMatrixThatIsNotPositiveDefiniteOrNotFinite)
{
  std::mt19937 random(13);
  const auto [n_blocks, cliques] = patterns()[4];
  for (const double spoilt :
       {-200.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const int at : {0, n_blocks / 2, n_blocks - 1})
    {
      SymmetricBlockMatrix matrix = random_matrix(n_blocks, cliques, random);
      SupernodalFactor factor(matrix, kernels_of(GetParam()));
      ASSERT_TRUE(factor.factorise(matrix));
      matrix.add_to_diagonal(at, spoilt);
      EXPECT_FALSE(factor.factorise(matrix));
    }
}

TEST_P(KernelsTest, GiveTheComplianceOfAnyNumberOfRows)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto &[n_blocks, cliques] : patterns())
  {
    const SymmetricBlockMatrix matrix = random_matrix(n_blocks, cliques, random);
    SupernodalFactor factor(matrix, kernels_of(GetParam()));
    ASSERT_TRUE(factor.factorise(matrix));
    const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(matrix.n_rows(), -1, 2);
    Eigen::VectorXd reduced = load;
    factor.solve_lower(reduced.data());
    Compliance compliance;
    for (const int n_rows : {1, 7, 8, 9, 23, 40, 5, 0}) // fewer after more: nothing of the larger ones may stay
    {
      SparseRows rows;
      Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n_rows, matrix.n_rows());
      for (int row = 0; row < n_rows; ++row)
      {
        for (int k = 0; k < 1 + row % 5; ++k)
        {
          const int column = static_cast<int>(random() % static_cast<unsigned>(matrix.n_rows()));
          rows.columns.push_back(column);
          rows.values.push_back(uniform(random));
          h(row, column) += rows.values.back();
        }
        rows.starts.push_back(static_cast<int>(rows.columns.size()));
      }
      compliance.compute(factor, rows, reduced);
      const Eigen::LLT<Eigen::MatrixXd> llt(dense(matrix));
      const Eigen::MatrixXd expected = h * llt.solve(h.transpose());
      const Eigen::MatrixXd difference = (compliance.result() - expected).triangularView<Eigen::Lower>();
      EXPECT_LE(difference.norm(), 1e-13 * expected.norm());
      const Eigen::VectorXd free_changes = h * llt.solve(load);
      for (int row = 0; row < n_rows; ++row)
        EXPECT_NEAR(compliance.free_change(row), free_changes[row], 1e-13);
      Eigen::VectorXd motion = reduced;
      const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(n_rows, 1, 3);
      compliance.add_combination(
          factor, [&](int k) { return factors[k]; }, motion);
      factor.solve_upper(motion.data());
      const Eigen::VectorXd expected_motion = llt.solve(load + h.transpose() * factors);
      EXPECT_LE((motion - expected_motion).norm(), 1e-13 * expected_motion.norm());
    }
  }
}

TEST_P(KernelsTest, AssembleTetrahedraAsTheElementSays)
{
  Body body = scene::hollow_ellipsoid({20, 30, 25}, 3, 1); // 240 elements: the last group of a cut body is not full
  body.tets.conservativeResize(body.tets.rows() - 3, 4);
  const int n_nodes = static_cast<int>(body.rest_positions.rows());
  std::vector<int> first_unknown(n_nodes);
  for (int node = 0; node < n_nodes; ++node)
    first_unknown[node] = 3 * ((node * 31) % n_nodes); // 84 nodes; 31 and 84 have no factor in common
  std::vector<std::vector<int>> cliques;
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
  {
    std::vector<int> &clique = cliques.emplace_back();
    for (int a = 0; a < 4; ++a)
      clique.push_back(first_unknown[body.tets(t, a)] / 3);
  }
  std::mt19937 random(19);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // From small strain to inverted elements: at 8 mm every wall is turned inside out somewhere.
  for (const double amplitude : {0.0, 0.1, 0.5, 8.0})
  {
    const Points positions =
        body.rest_positions + amplitude * Points::NullaryExpr(n_nodes, 3, [&] { return uniform(random); });
    SymmetricBlockMatrix matrix(n_nodes, cliques), expected_matrix(n_nodes, cliques);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * n_nodes), expected_load = load;
    TetrahedronAssembly(body, first_unknown, matrix, kernels_of(GetParam())).add(positions, matrix, load);
    const Lame material = lame_constants(body.youngs_modulus, body.poisson_ratio);
    int n_inverted = 0;
    for (Eigen::Index t = 0; t < body.tets.rows(); ++t)
    {
      Tetrahedron::NodalVectors rest, x;
      for (int a = 0; a < 4; ++a)
      {
        rest.col(a) = body.rest_positions.row(body.tets(t, a)).transpose();
        x.col(a) = positions.row(body.tets(t, a)).transpose();
      }
      const Tetrahedron element(rest, material);
      const Eigen::Matrix3d rotation = element.rotation(x);
      const Tetrahedron::NodalVectors force = element.force(rotation, x), turned = element.rotated_stiffness(rotation);
      n_inverted += (x * element.gradients().transpose()).determinant() < 0;
      for (int a = 0; a < 4; ++a)
      {
        const int row = first_unknown[body.tets(t, a)];
        expected_load.segment<3>(row) -= force.col(a);
        for (int b = 0; b < 4; ++b)
          if (const int column = first_unknown[body.tets(t, b)]; row >= column)
            expected_matrix.add(expected_matrix.find(row / 3, column / 3), element.stiffness_block(turned, a, b));
      }
    }
    EXPECT_EQ(n_inverted > 0, amplitude >= 8) << n_inverted;
    EXPECT_LE((load - expected_load).norm(), 1e-12 * (1 + expected_load.norm()));
    EXPECT_LE((dense(matrix) - dense(expected_matrix)).norm(), 1e-12 * dense(expected_matrix).norm());
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, KernelsTest, testing::Range(0, kernels::n_available()),
                         [](const auto &instance)
                         {
                           std::string name = kernels_of(instance.param).instruction_set;
                           std::erase(name, '-');
                           return name;
                         });
} // namespace pelvireg::registration
