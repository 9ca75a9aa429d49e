#include "registration/solver/body_solver.h"

#include <algorithm>

namespace pelvireg::registration
{
namespace
{
template <class Element>
typename Element::NodalVectors gather(const Points &positions, const std::array<int, Element::n_nodes> &nodes)
{
  typename Element::NodalVectors result;
  for (int a = 0; a < Element::n_nodes; ++a)
    result.col(a) = positions.row(nodes[a]).transpose();
  return result;
}
} // namespace

BodySolver::BodySolver(const Body &body, double time_step) : positions_(body.rest_positions), corrected_(positions_)
{
  inertia_.assign(positions_.rows(), 0.0);
  add_elements(tetrahedra_, body.tets, body);
  add_elements(hexahedra_, body.hexes, body);
  for (double &inertia : inertia_)
    inertia *= body.density / (time_step * time_step);
  number_unknowns(body);
  load_.setZero(n_unknowns());
  free_motion_.setZero(n_unknowns());
  correction_.setZero(n_unknowns());
}

template <class Element, class Connectivity>
void BodySolver::add_elements(ElementGroup<Element> &group, const Connectivity &cells, const Body &body)
{
  const Lame material = lame_constants(body.youngs_modulus, body.poisson_ratio);
  for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
  {
    std::array<int, Element::n_nodes> nodes;
    std::copy_n(cells.row(cell).data(), Element::n_nodes, nodes.begin());
    group.nodes.push_back(nodes);
    group.elements.emplace_back(gather<Element>(body.rest_positions, nodes), material);
    for (int a = 0; a < Element::n_nodes; ++a)
      inertia_[nodes[a]] += group.elements.back().volume_share(a);
  }
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
  const auto add_cliques = [&](const auto &group)
  {
    for (const auto &nodes : group.nodes)
    {
      std::vector<int> &clique = cliques.emplace_back();
      for (const int node : nodes)
        if (free_index[node] >= 0)
          clique.push_back(free_index[node]);
    }
  };
  add_cliques(tetrahedra_);
  add_cliques(hexahedra_);
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
  place_blocks(tetrahedra_);
  place_blocks(hexahedra_);
}

template <class Element> void BodySolver::place_blocks(ElementGroup<Element> &group)
{
  for (const auto &nodes : group.nodes)
  {
    for (int a = 0; a < Element::n_nodes; ++a)
      for (int b = 0; b < Element::n_nodes; ++b)
      {
        const int row = first_unknown_[nodes[a]], column = first_unknown_[nodes[b]];
        if (column >= 0 && row >= column)
          group.contributions.push_back({a, b, matrix_.slot(row / 3, column / 3)});
      }
    group.contribution_starts.push_back(static_cast<int>(group.contributions.size()));
  }
}

void BodySolver::assemble()
{
  matrix_.set_zero();
  load_.setZero();
  for (std::size_t node = 0; node < inertia_.size(); ++node)
    if (first_unknown_[node] >= 0)
      matrix_.add_to_diagonal(first_unknown_[node] / 3, inertia_[node]);
  assemble_group(tetrahedra_);
  assemble_group(hexahedra_);
}

template <class Element> void BodySolver::assemble_group(const ElementGroup<Element> &group)
{
  for (std::size_t e = 0; e < group.elements.size(); ++e)
  {
    const Element &element = group.elements[e];
    const auto x = gather<Element>(positions_, group.nodes[e]);
    const Eigen::Matrix3d rotation = element.rotation(x);
    const auto force = element.force(rotation, x);
    for (int a = 0; a < Element::n_nodes; ++a)
      if (const int first = first_unknown_[group.nodes[e][a]]; first >= 0)
        load_.segment<3>(first) -= force.col(a);
    const auto turned = element.rotated_stiffness(rotation);
    for (int k = group.contribution_starts[e]; k < group.contribution_starts[e + 1]; ++k)
    {
      const Contribution &c = group.contributions[k];
      matrix_.add(c.slot, element.stiffness_block(turned, c.a, c.b));
    }
  }
}

void BodySolver::predict_free_motion()
{
  if (n_unknowns() == 0)
    return;
  free_motion_ = load_;
  factor_->solve(free_motion_);
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
    compliance_.compute(*factor_, rows_);
}

double BodySolver::free_gap_change(int k) const
{
  double change = 0;
  for (int i = rows_.starts[k]; i < rows_.starts[k + 1]; ++i)
    change += rows_.values[i] * free_motion_[rows_.columns[i]];
  return change;
}

bool BodySolver::correct(const Eigen::VectorXd &multipliers)
{
  corrected_ = positions_;
  if (n_unknowns() == 0)
    return true;
  correction_.setZero();
  for (int k = 0; k < rows_.size(); ++k)
    for (int i = rows_.starts[k]; i < rows_.starts[k + 1]; ++i)
      correction_[rows_.columns[i]] += rows_.values[i] * multipliers[touching_rows_[k]];
  factor_->solve(correction_);
  correction_ += free_motion_;
  for (Eigen::Index node = 0; node < corrected_.rows(); ++node)
    if (first_unknown_[node] >= 0)
      corrected_.row(node) += correction_.segment<3>(first_unknown_[node]).transpose();
  return corrected_.allFinite();
}
} // namespace pelvireg::registration
