// The same linear algebra as it is usually done, to compare with: a simplicial factor and one full solve a row.
#pragma once

#include "registration/solver/body_solver.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <vector>

namespace pelvireg::bench
{
/// One body. The matrix and the rows are those of a BodySolver; Eigen's SimplicialLDLT with its own ordering, the
/// symbolic phase done once.
class UsualWay
{
public:
  explicit UsualWay(const registration::BodySolver &body);

  /// Copy A, b and H; not part of what is measured.
  void take(const registration::BodySolver &body, const registration::ConstraintRows &rows, int index);

  void factorise();
  void predict_free_motion();
  /// W = H A^-1 H^T, one solve with a full right-hand side for every row.
  void compute_compliance();
  /// A^-1 (b + H^T lambda); one multiplier for every row that touches the body.
  void correct(const Eigen::VectorXd &multipliers);

  const Eigen::MatrixXd &compliance() const { return compliance_; }
  const Eigen::VectorXd &motion() const { return motion_; }

private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
  Eigen::VectorXd load_, free_motion_, motion_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  Eigen::MatrixXd compliance_;
};
} // namespace pelvireg::bench
