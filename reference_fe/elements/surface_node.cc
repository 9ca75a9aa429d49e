#include "reference_fe/elements/surface_node.h"

namespace pelvireg::reference_fe
{
namespace
{
using NodeJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 7>;

/// dx / d(u, w, alpha).
NodeJacobian jacobian(const SurfaceNode &node, const Eigen::VectorXd &solution)
{
  NodeJacobian j(3, node.n_unknowns());
  j.leftCols<3>().setIdentity();
  if (node.side == 0)
    return j;
  const Eigen::Vector3d w = solution.segment<3>(node.first_unknown + 3);
  const double alpha = solution[node.first_unknown + 6];
  j.middleCols<3>(3) = node.half_thickness * (node.side + alpha) * Eigen::Matrix3d::Identity();
  j.col(6) = node.half_thickness * (node.director + w);
  return j;
}
} // namespace

Eigen::Vector3d SurfaceNode::rest_position() const
{
  return side == 0 ? rest : Eigen::Vector3d(rest + half_thickness * side * director);
}

Eigen::Vector3d SurfaceNode::position(const Eigen::VectorXd &solution) const
{
  Eigen::Vector3d x = rest + solution.segment<3>(first_unknown);
  if (side != 0)
    x += half_thickness * (side + solution[first_unknown + 6]) * (director + solution.segment<3>(first_unknown + 3));
  return x;
}

void append_unknowns(const std::vector<SurfaceNode> &nodes, std::vector<int> &indices)
{
  for (const SurfaceNode &node : nodes)
    for (int i = 0; i < node.n_unknowns(); ++i)
      indices.push_back(node.first_unknown + i);
}

Eigen::Matrix3Xd positions(const std::vector<SurfaceNode> &nodes, const Eigen::VectorXd &solution)
{
  Eigen::Matrix3Xd x(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = nodes[i].position(solution);
  return x;
}

void to_unknowns(const std::vector<SurfaceNode> &nodes, const Eigen::VectorXd &solution, const Eigen::VectorXd &force,
                 const Eigen::MatrixXd &stiffness, int n_extra, LocalSystem &local)
{
  const int n_nodes = static_cast<int>(nodes.size());
  std::vector<int> start(n_nodes + 1, 0);
  std::vector<NodeJacobian> j(n_nodes);
  for (int a = 0; a < n_nodes; ++a)
  {
    start[a + 1] = start[a] + nodes[a].n_unknowns();
    j[a] = jacobian(nodes[a], solution);
  }
  const int n = start[n_nodes];
  local.residual.setZero(n + n_extra);
  local.tangent.setZero(n + n_extra, n + n_extra);
  for (int a = 0; a < n_nodes; ++a)
  {
    const int n_a = nodes[a].n_unknowns();
    local.residual.segment(start[a], n_a) = j[a].transpose() * force.segment<3>(3 * a);
    for (int b = 0; b < n_nodes; ++b)
      local.tangent.block(start[a], start[b], n_a, nodes[b].n_unknowns()).noalias() =
          j[a].transpose() * stiffness.block<3, 3>(3 * a, 3 * b) * j[b];
    if (nodes[a].side != 0)
    {
      const Eigen::Vector3d f = nodes[a].half_thickness * force.segment<3>(3 * a);
      local.tangent.block<3, 1>(start[a] + 3, start[a] + 6) += f;
      local.tangent.block<1, 3>(start[a] + 6, start[a] + 3) += f.transpose();
    }
    local.tangent.block(start[a], n, n_a, n_extra) = j[a].transpose() * stiffness.block(3 * a, 3 * n_nodes, 3, n_extra);
    local.tangent.block(n, start[a], n_extra, n_a) = stiffness.block(3 * n_nodes, 3 * a, n_extra, 3) * j[a];
  }
  local.residual.tail(n_extra) = force.tail(n_extra);
  local.tangent.bottomRightCorner(n_extra, n_extra) = stiffness.bottomRightCorner(n_extra, n_extra);
}
} // namespace pelvireg::reference_fe
