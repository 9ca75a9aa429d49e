// Forces and stiffness of a body's hexahedra, added to its system.
#pragma once

#include "registration/elements/hexahedron.h"
#include "registration/registration.h"
#include "registration/solver/block_matrix.h"

#include <array>
#include <vector>

namespace pelvireg::registration
{
class HexahedronAssembly
{
public:
  /// As TetrahedronAssembly.
  HexahedronAssembly(const Body &body, const std::vector<int> &first_unknown, const SymmetricBlockMatrix &matrix);

  /// Add K to the matrix and -F to the load at the given positions. Without `follows_rotations` elements keep that of
  /// rest (Mutation::stale_rotations).
  void add(const Points &positions, SymmetricBlockMatrix &matrix, Eigen::VectorXd &load,
           bool follows_rotations = true) const;

private:
  /// One 3 x 3 block of one element's stiffness and the block of A that takes it.
  struct Contribution
  {
    int a = 0, b = 0;
    int block = 0;
  };

  std::vector<Hexahedron> elements_;
  std::vector<std::array<int, Hexahedron::n_nodes>> nodes_, unknowns_; ///< unknowns: -1 of a fixed node
  std::vector<Contribution> contributions_;
  std::vector<int> contribution_starts_{0};
};
} // namespace pelvireg::registration
