// Symbolic phase: elimination order and supernodes of a block matrix (CHOLMOD).
#pragma once

#include "registration/solver/block_matrix.h"

#include <vector>

namespace pelvireg::registration
{
/// Order of the blocks that keeps the factor sparse: result[k] is the block eliminated k-th (the better of CHOLMOD's
/// AMD and nested dissection, postordered). `cliques` as in SymmetricBlockMatrix.
std::vector<int> fill_reducing_order(int n_blocks, const std::vector<std::vector<int>> &cliques);

/// Supernode s: consecutive block columns first_block[s] … first_block[s + 1] - 1 of L with the same rows below them,
/// below_rows[below_starts[s]] … (block indices, ascending). Some zeros are stored where that makes supernodes larger.
struct SupernodeTree
{
  std::vector<int> first_block;
  std::vector<int> below_starts;
  std::vector<int> below_rows;
  std::vector<int> parent; ///< the supernode that s updates next on its way to the root; -1 at a root

  int size() const { return static_cast<int>(parent.size()); }
};

/// The matrix must already be in a fill-reducing, postordered order. Throws std::runtime_error when memory is
/// exhausted.
SupernodeTree analyse(const SymmetricBlockMatrix &matrix);
} // namespace pelvireg::registration
