#include "registration/solver/hexahedron_assembly.h"

namespace pelvireg::registration
{
namespace
{
Hexahedron::NodalVectors gather(const Points &positions, const std::array<int, Hexahedron::n_nodes> &nodes)
{
  Hexahedron::NodalVectors result;
  for (int a = 0; a < Hexahedron::n_nodes; ++a)
    result.col(a) = positions.row(nodes[a]).transpose();
  return result;
}
} // namespace

HexahedronAssembly::HexahedronAssembly(const Body &body, const std::vector<int> &first_unknown,
                                       const SymmetricBlockMatrix &matrix)
{
  const Lame material = lame_constants(body.youngs_modulus, body.poisson_ratio);
  for (Eigen::Index cell = 0; cell < body.hexes.rows(); ++cell)
  {
    std::array<int, Hexahedron::n_nodes> &nodes = nodes_.emplace_back();
    std::array<int, Hexahedron::n_nodes> &unknowns = unknowns_.emplace_back();
    for (int a = 0; a < Hexahedron::n_nodes; ++a)
    {
      nodes[a] = body.hexes(cell, a);
      unknowns[a] = first_unknown[nodes[a]];
    }
    elements_.emplace_back(gather(body.rest_positions, nodes), material);
    for (int a = 0; a < Hexahedron::n_nodes; ++a)
      for (int b = 0; b < Hexahedron::n_nodes; ++b)
        if (unknowns[b] >= 0 && unknowns[a] >= unknowns[b])
          contributions_.push_back({a, b, matrix.find(unknowns[a] / 3, unknowns[b] / 3)});
    contribution_starts_.push_back(static_cast<int>(contributions_.size()));
  }
}

void HexahedronAssembly::add(const Points &positions, SymmetricBlockMatrix &matrix, Eigen::VectorXd &load,
                             bool follows_rotations) const
{
  for (std::size_t e = 0; e < elements_.size(); ++e)
  {
    const Hexahedron &element = elements_[e];
    const Hexahedron::NodalVectors x = gather(positions, nodes_[e]);
    const Eigen::Matrix3d rotation =
        follows_rotations ? element.rotation(x) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const Hexahedron::NodalVectors force = element.force(rotation, x);
    for (int a = 0; a < Hexahedron::n_nodes; ++a)
      if (unknowns_[e][a] >= 0)
        load.segment<3>(unknowns_[e][a]) -= force.col(a);
    const Eigen::Matrix<double, 8, 8> tension = element.tension_stiffness(rotation, x);
    for (int k = contribution_starts_[e]; k < contribution_starts_[e + 1]; ++k)
    {
      const Contribution &c = contributions_[k];
      Eigen::Matrix3d block = element.stiffness_block(rotation, c.a, c.b);
      block.diagonal().array() += tension(c.a, c.b);
      matrix.add(c.block, block);
    }
  }
}
} // namespace pelvireg::registration
