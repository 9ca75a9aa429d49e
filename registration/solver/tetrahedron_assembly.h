// Forces and stiffness of a body's tetrahedra, added to its system eight at a time.
#pragma once

#include "registration/elements/tetrahedron.h"
#include "registration/kernels/kernels.h"
#include "registration/registration.h"
#include "registration/solver/block_matrix.h"

#include <array>
#include <vector>

namespace pelvireg::registration
{
/// What it adds is what Tetrahedron says, to round-off.
class TetrahedronAssembly
{
public:
  /// first_unknown: of every node, a multiple of 3; -1 when the node is fixed. The matrix has the pattern of the
  /// elements' free nodes.
  TetrahedronAssembly(const Body &body, const std::vector<int> &first_unknown, const SymmetricBlockMatrix &matrix,
                      const kernels::Kernels &kernels = kernels::best());

  /// Add K to the matrix and -F to the load at the given positions. Without `follows_rotations` elements keep that of
  /// rest (Mutation::stale_rotations).
  void add(const Points &positions, SymmetricBlockMatrix &matrix, Eigen::VectorXd &load,
           bool follows_rotations = true) const;

private:
  static constexpr int n_pairs = 10; ///< of an element's nodes, a >= b
  /// Where the results of one lane go; -1: nowhere.
  struct Target
  {
    std::array<int, Tetrahedron::n_nodes> unknowns;
    std::array<int, n_pairs> blocks;
  };

  const kernels::Kernels *kernels_;
  std::vector<kernels::TetrahedronGroup> groups_;
  std::vector<Target> targets_; ///< kernels::width a group
};
} // namespace pelvireg::registration
