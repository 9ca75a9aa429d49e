// Contact forces of the last step, to start the next solve from.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelvireg::registration
{
/// Forces on body a in space (N), by pair and cell.
class ContactMemory
{
public:
  /// Forget everything; keeps the memory.
  void clear() { entries_.clear(); }
  void reserve(std::size_t n_contacts) { entries_.reserve(n_contacts); }
  /// In ascending order of (pair, cell).
  void remember(int pair, std::int64_t cell, const Eigen::Vector3d &force) { entries_.push_back({pair, cell, force}); }
  /// Zero when there was no contact.
  Eigen::Vector3d recall(int pair, std::int64_t cell) const;

private:
  struct Entry
  {
    int pair = 0;
    std::int64_t cell = 0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
  };
  std::vector<Entry> entries_;
};
} // namespace pelvireg::registration
