#include "registration/solver/body_solver.h"

namespace pelvireg::registration
{
namespace
{
/// Sum over the body's elements of what each node carries of their volume, mm^3.
template <class Element, class Connectivity>
void add_volume_shares(const Body &body, const Connectivity &cells, std::vector<double> &shares)
{
  const Lame material = lame_constants(body.youngs_modulus, body.poisson_ratio);
  for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
  {
    typename Element::NodalVectors rest;
    for (int a = 0; a < Element::n_nodes; ++a)
      rest.col(a) = body.rest_positions.row(cells(cell, a)).transpose();
    const Element element(rest, material);
    for (int a = 0; a < Element::n_nodes; ++a)
      shares[cells(cell, a)] += element.volume_share(a);
  }
}

/// The free nodes of every element, by their index among the free ones.
template <class Connectivity>
void add_cliques(const Connectivity &cells, const std::vector<int> &free_index, std::vector<std::vector<int>> &cliques)
{
  for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
  {
    std::vector<int> &clique = cliques.emplace_back();
    for (Eigen::Index a = 0; a < cells.cols(); ++a)
      if (free_index[cells(cell, a)] >= 0)
        clique.push_back(free_index[cells(cell, a)]);
  }
}
} // namespace

BodySolver::BodySolver(const Body &body, double time_step, bool follows_rotations)
    : positions_(body.rest_positions), corrected_(positions_), follows_rotations_(follows_rotations)
{
  inertia_.assign(positions_.rows(), 0.0);
  add_volume_shares<Tetrahedron>(body, body.tets, inertia_);
  add_volume_shares<Hexahedron>(body, body.hexes, inertia_);
  for (double &inertia : inertia_)
    inertia *= body.density / (time_step * time_step);
  number_unknowns(body);
  tetrahedra_.emplace(body, first_unknown_, matrix_);
  hexahedra_.emplace(body, first_unknown_, matrix_);
  load_.setZero(n_unknowns());
  reduced_load_.setZero(n_unknowns());
  correction_.setZero(n_unknowns());
}

void BodySolver::number_unknowns(const Body &body)
{
  const int n_nodes = static_cast<int>(positions_.rows());
  std::vector<char> is_fixed(n_nodes, 0);
  for (const int node : body.fixed_nodes)
    is_fixed[node] = 1;
  std::vector<int> free_index(n_nodes, -1);
  for (int node = 0; node < n_nodes; ++node)
    if (!is_fixed[node])
      free_index[node] = n_free_nodes_++;
  first_unknown_.assign(n_nodes, -1);
  if (n_free_nodes_ == 0)
    return;

  std::vector<std::vector<int>> cliques;
  add_cliques(body.tets, free_index, cliques);
  add_cliques(body.hexes, free_index, cliques);
  const std::vector<int> order = fill_reducing_order(n_free_nodes_, cliques);
  std::vector<int> rank(n_free_nodes_);
  for (int k = 0; k < n_free_nodes_; ++k)
    rank[order[k]] = k;
  for (std::vector<int> &clique : cliques)
    for (int &index : clique)
      index = rank[index];
  for (int node = 0; node < n_nodes; ++node)
    if (free_index[node] >= 0)
      first_unknown_[node] = 3 * rank[free_index[node]];

  matrix_ = SymmetricBlockMatrix(n_free_nodes_, cliques);
  factor_.emplace(matrix_);
}

void BodySolver::assemble()
{
  matrix_.set_zero();
  load_.setZero();
  for (std::size_t node = 0; node < inertia_.size(); ++node)
    if (first_unknown_[node] >= 0)
      matrix_.add_to_diagonal(first_unknown_[node] / 3, inertia_[node]);
  tetrahedra_->add(positions_, matrix_, load_, follows_rotations_);
  hexahedra_->add(positions_, matrix_, load_, follows_rotations_);
}

void BodySolver::predict_free_motion()
{
  reduced_load_ = load_;
  if (n_unknowns() > 0)
    factor_->solve_lower(reduced_load_.data());
}

void BodySolver::reserve_rows(int n_rows, std::size_t n_nodes)
{
  touching_rows_.reserve(n_rows);
  rows_.reserve(n_rows, 3 * n_nodes);
  if (n_unknowns() > 0)
    compliance_.reserve(*factor_, n_rows);
}

void BodySolver::gather_rows(const ConstraintRows &rows, int body)
{
  touching_rows_.clear();
  rows_.clear();
  for (int row = 0; row < rows.size(); ++row)
  {
    const std::size_t before = rows_.columns.size();
    for (const RowEntry *entry = rows.begin(row); entry != rows.end(row); ++entry)
    {
      const int first = entry->body == body ? first_unknown_[entry->node] : -1;
      if (first < 0)
        continue;
      for (int axis = 0; axis < 3; ++axis)
        if (entry->jacobian[axis] != 0)
        {
          rows_.columns.push_back(first + axis);
          rows_.values.push_back(entry->jacobian[axis]);
        }
    }
    if (rows_.columns.size() == before)
      continue;
    touching_rows_.push_back(row);
    rows_.starts.push_back(static_cast<int>(rows_.columns.size()));
  }
}

void BodySolver::compute_compliance()
{
  if (n_unknowns() > 0)
    compliance_.compute(*factor_, rows_, reduced_load_);
}

bool BodySolver::correct(const Eigen::VectorXd &multipliers)
{
  corrected_ = positions_;
  if (n_unknowns() == 0)
    return true;
  correction_ = reduced_load_;
  if (rows_.size() > 0)
    compliance_.add_combination(
        *factor_, [&](int k) { return multipliers[touching_rows_[k]]; }, correction_);
  factor_->solve_upper(correction_.data());
  for (Eigen::Index node = 0; node < corrected_.rows(); ++node)
    if (first_unknown_[node] >= 0)
      corrected_.row(node) += correction_.segment<3>(first_unknown_[node]).transpose();
  return corrected_.allFinite();
}
} // namespace pelvireg::registration
