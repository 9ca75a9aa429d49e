#include "tests/verification/supports/registration_statics.h"

#include "registration/constraints/attachment.h"
#include "registration/solver/body_solver.h"

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

namespace pelvireg::test
{
namespace
{
using registration::AttachedNode;
using registration::BodySolver;

constexpr double static_time_step = 1e6; // s: M / h^2 vanishes beside the stiffness

registration::Body converted(const dataset::RegistrationModel &model, const std::string &name)
{
  const auto found =
      std::find_if(model.bodies.begin(), model.bodies.end(), [&](const auto &b) { return b.name == name; });
  if (found == model.bodies.end())
    throw std::runtime_error("no body " + name);
  registration::Body body;
  body.name = name;
  body.rest_positions = found->points;
  body.tets = found->tets;
  body.hexes = found->hexes;
  body.youngs_modulus = found->youngs_modulus;
  body.poisson_ratio = found->poisson_ratio;
  body.density = found->density;
  body.fixed_nodes.assign(found->fixed_nodes.begin(), found->fixed_nodes.end());
  body.outer_triangles = found->outer_triangles;
  return body;
}

Eigen::MatrixXd stiffness(BodySolver &solver)
{
  solver.assemble();
  const registration::SymmetricBlockMatrix &matrix = solver.matrix();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(matrix.n_rows(), matrix.n_rows());
  for (int column = 0; column < matrix.n_blocks(); ++column)
    for (int k = matrix.block_starts()[column]; k < matrix.block_starts()[column + 1]; ++k)
    {
      const int row = matrix.block_rows()[k];
      const Eigen::Map<const Eigen::Matrix3d> block(matrix.values() +
                                                    registration::SymmetricBlockMatrix::block_size * k);
      if (row == column)
        dense.block<3, 3>(3 * row, 3 * row) = block.selfadjointView<Eigen::Lower>();
      else
      {
        dense.block<3, 3>(3 * row, 3 * column) = block;
        dense.block<3, 3>(3 * column, 3 * row) = block.transpose();
      }
    }
  return dense;
}

/// Nodes of a grid held on the walls of an organ; body 0 is the organ, body 1 the grid.
std::vector<AttachedNode> attached_nodes(const dataset::RegistrationModel &model,
                                         const std::vector<registration::Body> &bodies)
{
  const registration::TriangleTree tree(bodies[0].outer_triangles, bodies[0].rest_positions);
  std::vector<AttachedNode> nodes;
  for (const dataset::RegistrationAttachment &attachment : model.attachments)
    if (attachment.body_a == bodies[1].name && attachment.body_b == bodies[0].name)
    {
      const registration::Attachment one = {
          attachment.name, 1, {attachment.nodes_a.begin(), attachment.nodes_a.end()}, 0, 0};
      const std::vector<AttachedNode> bound = registration::bind_attachment(one, bodies, tree, 0);
      nodes.insert(nodes.end(), bound.begin(), bound.end());
    }
  return nodes;
}
} // namespace

Eigen::Matrix3d compliance_of_organ(const dataset::RegistrationModel &model, const std::string &organ,
                                    const std::string &grid, const std::vector<int> &nodes)
{
  const std::vector<registration::Body> bodies = {converted(model, organ), converted(model, grid)};
  BodySolver organ_solver(bodies[0], static_time_step), grid_solver(bodies[1], static_time_step);
  const std::vector<AttachedNode> attached = attached_nodes(model, bodies);
  const int n_organ = organ_solver.n_unknowns(), n_grid = grid_solver.n_unknowns();
  const int n = n_organ + n_grid + 3 * static_cast<int>(attached.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n); // [K H^T; H 0]
  system.topLeftCorner(n_organ, n_organ) = stiffness(organ_solver);
  system.block(n_organ, n_organ, n_grid, n_grid) = stiffness(grid_solver);
  registration::ConstraintRows rows;
  for (const AttachedNode &node : attached)
    registration::add_attachment_rows(node, bodies[1].rest_positions, bodies[0].rest_positions, rows);
  for (int row = 0; row < rows.size(); ++row)
    for (const registration::RowEntry *entry = rows.begin(row); entry != rows.end(row); ++entry)
    {
      const BodySolver &solver = entry->body == 0 ? organ_solver : grid_solver;
      const int unknown = solver.first_unknown(entry->node) + (entry->body == 0 ? 0 : n_organ);
      if (solver.first_unknown(entry->node) < 0)
        continue;
      const int multiplier = n_organ + n_grid + row;
      system.block<1, 3>(multiplier, unknown) += entry->jacobian.transpose();
      system.block<3, 1>(unknown, multiplier) += entry->jacobian;
    }

  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(n, 3);
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis)
      if (const int first = organ_solver.first_unknown(node); first >= 0)
        load(first + axis, axis) += 1.0 / static_cast<double>(nodes.size());
  return load.transpose() * system.fullPivLu().solve(load);
}

Eigen::Matrix3d stiffness_of_band(const dataset::RegistrationModel &model,
                                  const dataset::RegistrationAttachment &attachment)
{
  // Springs that outweigh the band hold its organ's end; their forces under a motion of their feet are wanted. The
  // other bands of the same grid are not touched, so they stay at rest.
  constexpr double spring = 1e6; // N/mm
  BodySolver solver(converted(model, attachment.body_a), static_time_step);
  Eigen::MatrixXd system = stiffness(solver), load = Eigen::MatrixXd::Zero(system.rows(), 3);
  for (const std::int32_t node : attachment.nodes_a)
    for (int axis = 0; axis < 3; ++axis)
    {
      const int unknown = solver.first_unknown(node) + axis;
      system(unknown, unknown) += spring;
      load(unknown, axis) = spring;
    }
  const Eigen::MatrixXd motion = system.ldlt().solve(load);
  Eigen::Matrix3d force = Eigen::Matrix3d::Zero();
  for (const std::int32_t node : attachment.nodes_a)
    for (int axis = 0; axis < 3; ++axis)
    {
      const int unknown = solver.first_unknown(node) + axis;
      force.row(axis) += load.row(unknown) - spring * motion.row(unknown);
    }
  return force;
}
} // namespace pelvireg::test
