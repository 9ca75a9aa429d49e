// The elimination order decides every rounding of a step, so it must not depend on what other threads do.
#include "registration/solver/supernode_tree.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace pelvireg::registration
{
namespace
{
/// Cells of a box of n x n x 3 cubes, eight nodes each: a hollow organ's wall, where nested dissection wins.
std::vector<std::vector<int>> wall(int n)
{
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  std::vector<std::vector<int>> cells;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        cells.push_back({node(i, j, k), node(i + 1, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i, j, k + 1),
                         node(i + 1, j, k + 1), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1)});
  return cells;
}

TEST(FillReducingOrder, IsTheSameWhenSeveralThreadsAskForOne)
{
  constexpr int n = 24, n_blocks = 25 * 25 * 4;
  const std::vector<std::vector<int>> cells = wall(n);
  const std::vector<int> alone = fill_reducing_order(n_blocks, cells);
  std::atomic<int> n_others{0};
  const auto ask = [&]
  {
    for (int repetition = 0; repetition < 20; ++repetition)
      n_others += fill_reducing_order(n_blocks, cells) != alone;
  };
  std::thread helper(ask);
  ask();
  helper.join();
  EXPECT_EQ(n_others, 0);
}
} // namespace
} // namespace pelvireg::registration
