#include "tests/benchmark/usual_way.h"

namespace pelvireg::bench
{
using namespace registration;

namespace
{
/// Every entry of the lower half, as triplets in the order of the blocks.
template <class Visit> void for_each_entry(const SymmetricBlockMatrix &matrix, const Visit &visit)
{
  for (int column = 0; column < matrix.n_blocks(); ++column)
    for (int k = matrix.block_starts()[column]; k < matrix.block_starts()[column + 1]; ++k)
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
          if (3 * matrix.block_rows()[k] + r >= 3 * column + c)
            visit(3 * matrix.block_rows()[k] + r, 3 * column + c,
                  matrix.values()[SymmetricBlockMatrix::block_size * k + 3 * c + r]);
}
} // namespace

UsualWay::UsualWay(const BodySolver &body) : matrix_(body.n_unknowns(), body.n_unknowns())
{
  std::vector<Eigen::Triplet<double>> triplets;
  for_each_entry(body.matrix(), [&](int row, int column, double) { triplets.emplace_back(row, column, 1.0); });
  matrix_.setFromTriplets(triplets.begin(), triplets.end());
  factor_.analyzePattern(matrix_);
}

void UsualWay::take(const BodySolver &body, const ConstraintRows &rows, int index)
{
  for_each_entry(body.matrix(), [this](int row, int column, double value) { matrix_.coeffRef(row, column) = value; });
  load_ = body.load();
  std::vector<Eigen::Triplet<double>> triplets;
  const std::vector<int> &touching = body.touching_rows();
  for (std::size_t k = 0; k < touching.size(); ++k)
    for (const RowEntry *entry = rows.begin(touching[k]); entry != rows.end(touching[k]); ++entry)
      if (entry->body == index && body.first_unknown(entry->node) >= 0)
        for (int axis = 0; axis < 3; ++axis)
          triplets.emplace_back(static_cast<int>(k), body.first_unknown(entry->node) + axis, entry->jacobian[axis]);
  rows_.resize(static_cast<Eigen::Index>(touching.size()), body.n_unknowns());
  rows_.setFromTriplets(triplets.begin(), triplets.end());
}

void UsualWay::factorise()
{
  factor_.factorize(matrix_);
}

void UsualWay::predict_free_motion()
{
  free_motion_ = factor_.solve(load_);
}

void UsualWay::compute_compliance()
{
  compliance_.resize(rows_.rows(), rows_.rows());
  for (Eigen::Index row = 0; row < rows_.rows(); ++row)
  {
    const Eigen::VectorXd side = rows_.row(row).transpose();
    compliance_.col(row) = rows_ * factor_.solve(side);
  }
}

void UsualWay::correct(const Eigen::VectorXd &multipliers)
{
  const Eigen::VectorXd force = rows_.transpose() * multipliers;
  motion_ = free_motion_ + factor_.solve(force);
}
} // namespace pelvireg::bench
