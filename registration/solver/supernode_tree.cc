#include "registration/solver/supernode_tree.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <string>

namespace pelvireg::registration
{
namespace
{
/// CHOLMOD's symbolic analysis of a lower pattern of n block rows.
class Analysis
{
public:
  enum class Order
  {
    fill_reducing,
    given
  };

  /// CHOLMOD takes no const pointers, but does not change the pattern.
  Analysis(int n, const std::vector<int> &starts, const std::vector<int> &rows, Order order)
  {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    // CHOLMOD's own limits for merging supernodes (4, 16, 48 columns), which it counts in columns, in nodes.
    std::copy_n(std::array<std::size_t, 3>{2, 5, 16}.begin(), 3, common_.nrelax);
    // The one with the least fill. Nested dissection has 5 % less on an organ, 10 % less at ten times its size, and a
    // shallower tree.
    common_.nmethods = 2;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.method[1].ordering = CHOLMOD_NESDIS;
    if (order == Order::given)
    {
      common_.nmethods = 1;
      common_.method[0].ordering = CHOLMOD_NATURAL;
      common_.postorder = 0;
    }
    cholmod_sparse pattern{};
    pattern.nrow = pattern.ncol = n;
    pattern.nzmax = rows.size();
    pattern.p = const_cast<int *>(starts.data());
    pattern.i = const_cast<int *>(rows.data());
    pattern.stype = -1;
    pattern.itype = CHOLMOD_INT;
    pattern.xtype = CHOLMOD_PATTERN;
    pattern.dtype = CHOLMOD_DOUBLE;
    pattern.sorted = 1;
    pattern.packed = 1;
    {
      // METIS, behind nested dissection, draws from the C library's rand(), which it seeds itself: two analyses at once
      // would share the sequence, and the order would depend on their timing.
      static std::mutex one_at_a_time;
      const std::lock_guard lock(one_at_a_time);
      factor_ = cholmod_analyze(&pattern, &common_);
    }
    if (factor_ && factor_->is_super)
      return;
    release();
    throw std::runtime_error("registration: CHOLMOD could not analyse a matrix of " + std::to_string(n) +
                             " nodes; the memory is exhausted or the library lacks its supernodal part");
  }
  ~Analysis() { release(); }
  Analysis(const Analysis &) = delete;
  Analysis &operator=(const Analysis &) = delete;

  const cholmod_factor &factor() const { return *factor_; }

private:
  void release()
  {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  cholmod_common common_{};
  cholmod_factor *factor_ = nullptr;
};
} // namespace

std::vector<int> fill_reducing_order(int n_blocks, const std::vector<std::vector<int>> &cliques)
{
  const SymmetricBlockMatrix graph(n_blocks, cliques);
  const Analysis analysis(n_blocks, graph.block_starts(), graph.block_rows(), Analysis::Order::fill_reducing);
  const int *order = static_cast<const int *>(analysis.factor().Perm);
  return {order, order + n_blocks};
}

SupernodeTree analyse(const SymmetricBlockMatrix &matrix)
{
  const Analysis analysis(matrix.n_blocks(), matrix.block_starts(), matrix.block_rows(), Analysis::Order::given);
  const cholmod_factor &factor = analysis.factor();
  const int n = static_cast<int>(factor.nsuper);
  const int *first = static_cast<const int *>(factor.super);
  const int *row_starts = static_cast<const int *>(factor.pi);
  const int *rows = static_cast<const int *>(factor.s);
  SupernodeTree tree;
  tree.first_block.assign(first, first + n + 1);
  tree.below_starts.push_back(0);
  std::vector<int> supernode_of(matrix.n_blocks());
  for (int s = 0; s < n; ++s)
  {
    std::fill(supernode_of.begin() + first[s], supernode_of.begin() + first[s + 1], s);
    tree.below_rows.insert(tree.below_rows.end(), rows + row_starts[s] + (first[s + 1] - first[s]),
                           rows + row_starts[s + 1]);
    tree.below_starts.push_back(static_cast<int>(tree.below_rows.size()));
  }
  for (int s = 0; s < n; ++s)
    tree.parent.push_back(
        tree.below_starts[s] == tree.below_starts[s + 1] ? -1 : supernode_of[tree.below_rows[tree.below_starts[s]]]);
  return tree;
}
} // namespace pelvireg::registration
