// One body of the block-diagonal system: elements, matrix A, factor, free motion and its part of W.
#pragma once

#include "registration/constraints/constraint_rows.h"
#include "registration/registration.h"
#include "registration/solver/block_matrix.h"
#include "registration/solver/compliance.h"
#include "registration/solver/hexahedron_assembly.h"
#include "registration/solver/supernodal_factor.h"
#include "registration/solver/tetrahedron_assembly.h"

#include <optional>
#include <vector>

namespace pelvireg::registration
{
/// State and linear algebra of one body. Bodies share nothing, so that several threads may each work on one.
class BodySolver
{
public:
  /// `body` must have passed check_model(). time_step in s. Without `follows_rotations` elements keep that of rest
  /// (Mutation::stale_rotations).
  BodySolver(const Body &body, double time_step, bool follows_rotations = true);

  const Points &positions() const { return positions_; }
  void set_positions(const Points &positions) { positions_ = positions; }

  /// A = M / h^2 + K(q) and b = -F(q) at the current positions (paper, equation 8, times 1/h).
  void assemble();
  /// False when A is not positive definite.
  bool factorise() { return n_unknowns() == 0 || factor_->factorise(matrix_); }
  /// L^-1 b, all that the constraints need of the free motion A^-1 b.
  void predict_free_motion();

  /// Set memory aside for so many constraint rows that touch this body, with so many nodes in all.
  void reserve_rows(int n_rows, std::size_t n_nodes);
  /// Take the part of the constraint rows that touches this body; `body` is this body's index in them.
  void gather_rows(const ConstraintRows &rows, int body);
  /// Its part of W = H A^-1 H^T and H x_free over touching_rows(), after predict_free_motion().
  void compute_compliance();
  /// Global indices of the rows that touch this body, ascending.
  const std::vector<int> &touching_rows() const { return touching_rows_; }
  /// Lower triangle; size touching_rows().size().
  Eigen::Map<const Eigen::MatrixXd> compliance() const { return compliance_.result(); }
  /// (H x_free) of touching row k, mm.
  double free_gap_change(int k) const { return compliance_.free_change(k); }

  /// positions + A^-1 (b + H^T lambda), into corrected_positions(); false when not finite. After compute_compliance(),
  /// or with no rows.
  bool correct(const Eigen::VectorXd &multipliers);
  const Points &corrected_positions() const { return corrected_; }
  /// Make the corrected positions current.
  void accept() { positions_.swap(corrected_); }

  int n_unknowns() const { return 3 * n_free_nodes_; }
  const SymmetricBlockMatrix &matrix() const { return matrix_; }
  /// Values stored for the factor.
  long n_factor_values() const { return factor_ ? factor_->n_stored_values() : 0; }
  /// b = -F(q) over the unknowns, N.
  const Eigen::VectorXd &load() const { return load_; }
  /// Index of the first of a node's three unknowns; -1 when the node is fixed.
  int first_unknown(int node) const { return first_unknown_[node]; }

private:
  void number_unknowns(const Body &body);

  Points positions_, corrected_;
  int n_free_nodes_ = 0;
  std::vector<int> first_unknown_;
  std::vector<double> inertia_; ///< m / h^2 of each node, N/mm
  SymmetricBlockMatrix matrix_;
  std::optional<TetrahedronAssembly> tetrahedra_;
  std::optional<HexahedronAssembly> hexahedra_;
  bool follows_rotations_ = true;
  std::optional<SupernodalFactor> factor_;
  Eigen::VectorXd load_, reduced_load_, correction_;
  std::vector<int> touching_rows_;
  SparseRows rows_;
  Compliance compliance_;
};
} // namespace pelvireg::registration
