#include "registration/solver/tetrahedron_assembly.h"

#include "registration/elements/rotation.h"

#include <algorithm>

namespace pelvireg::registration
{
namespace
{
using kernels::width;

/// Nodes by ascending unknown, so that block (a, b), a >= b, is one of the matrix' lower half; fixed ones first.
std::array<int, Tetrahedron::n_nodes> sorted_nodes(const Tets &tets, Eigen::Index cell,
                                                   const std::vector<int> &first_unknown)
{
  std::array<int, Tetrahedron::n_nodes> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(),
            [&](int a, int b)
            { return std::pair(first_unknown[tets(cell, a)], a) < std::pair(first_unknown[tets(cell, b)], b); });
  return order;
}

Tetrahedron element_of(const Body &body, Eigen::Index cell, const Lame &material)
{
  Tetrahedron::NodalVectors rest;
  for (int a = 0; a < Tetrahedron::n_nodes; ++a)
    rest.col(a) = body.rest_positions.row(body.tets(cell, a)).transpose();
  return Tetrahedron(rest, material);
}

void rotation_of_lane(const double (&f)[9], double (&q)[9])
{
  Eigen::Map<Eigen::Matrix3d>(+q) = rotation_of(Eigen::Map<const Eigen::Matrix3d>(+f));
}

void rotation_of_rest(const double (&)[9], double (&q)[9])
{
  Eigen::Map<Eigen::Matrix3d>(+q).setIdentity();
}
} // namespace

TetrahedronAssembly::TetrahedronAssembly(const Body &body, const std::vector<int> &first_unknown,
                                         const SymmetricBlockMatrix &matrix, const kernels::Kernels &kernels)
    : kernels_(&kernels)
{
  const Lame material = lame_constants(body.youngs_modulus, body.poisson_ratio);
  const int n_tets = static_cast<int>(body.tets.rows());
  groups_.resize(kernels::padded(n_tets) / width);
  targets_.resize(groups_.size() * width);
  for (int k = 0; k < static_cast<int>(targets_.size()); ++k)
  {
    const bool is_element = k < n_tets; // the lanes that fill the last group repeat its last element, without volume
    const Eigen::Index cell = std::min(k, n_tets - 1);
    const Tetrahedron element = element_of(body, cell, material);
    const std::array<int, Tetrahedron::n_nodes> order = sorted_nodes(body.tets, cell, first_unknown);
    kernels::TetrahedronGroup &group = groups_[k / width];
    Target &target = targets_[k];
    const int lane = k % width;
    group.volume_lambda[lane] = is_element ? element.volume() * material.lambda : 0;
    group.volume_mu[lane] = is_element ? element.volume() * material.mu : 0;
    for (int a = 0, pair = 0; a < Tetrahedron::n_nodes; ++a)
    {
      group.nodes[a][lane] = body.tets(cell, order[a]);
      target.unknowns[a] = is_element ? first_unknown[group.nodes[a][lane]] : -1;
      for (int axis = 0; axis < 3; ++axis)
        group.gradients[3 * a + axis][lane] = element.gradients()(axis, order[a]);
      for (int b = 0; b <= a; ++b, ++pair)
        target.blocks[pair] =
            target.unknowns[b] >= 0 ? matrix.find(target.unknowns[a] / 3, target.unknowns[b] / 3) : -1;
    }
  }
}

void TetrahedronAssembly::add(const Points &positions, SymmetricBlockMatrix &matrix, Eigen::VectorXd &load,
                              bool follows_rotations) const
{
  kernels::TetrahedronResult result;
  for (std::size_t g = 0; g < groups_.size(); ++g)
  {
    kernels_->assemble_tetrahedra(groups_[g], positions.data(), follows_rotations ? rotation_of_lane : rotation_of_rest,
                                  result);
    for (int lane = 0; lane < width; ++lane)
    {
      const Target &target = targets_[g * width + lane];
      for (int a = 0; a < Tetrahedron::n_nodes; ++a)
        if (target.unknowns[a] >= 0)
          for (int axis = 0; axis < 3; ++axis)
            load[target.unknowns[a] + axis] -= result.forces[3 * a + axis][lane];
      for (int pair = 0; pair < n_pairs; ++pair)
        if (target.blocks[pair] >= 0)
          for (int entry = 0; entry < SymmetricBlockMatrix::block_size; ++entry)
            matrix.values()[SymmetricBlockMatrix::block_size * target.blocks[pair] + entry] +=
                result.blocks[SymmetricBlockMatrix::block_size * pair + entry][lane];
    }
  }
}
} // namespace pelvireg::registration
