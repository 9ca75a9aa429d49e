#include "registration/constraints/contact_memory.h"

#include <algorithm>
#include <utility>

namespace pelvireg::registration
{
Eigen::Vector3d ContactMemory::recall(int pair, std::int64_t cell) const
{
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), std::pair(pair, cell),
                       [](const Entry &entry, const auto &key) { return std::pair(entry.pair, entry.cell) < key; });
  const bool is_there = found != entries_.end() && found->pair == pair && found->cell == cell;
  return is_there ? found->force : Eigen::Vector3d::Zero().eval();
}
} // namespace pelvireg::registration
