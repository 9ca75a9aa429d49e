// The linearised constraints of one step: H, delta and the compliance of every row (paper, equations 9 and 10).
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pelvireg::registration
{
/// What a row stands for.
enum class RowKind
{
  sliding,    ///< omega: a control point of the outline
  attachment, ///< chi: an attached node, one row an axis
  contact,    ///< phi: overlap of two bodies in a cell; unilateral
  friction,   ///< along a contact's surface; two follow their contact row
};

/// A row's Jacobian with respect to one node: d(row) / d(position of the node).
struct RowEntry
{
  int body = 0;
  int node = 0;
  Eigen::Vector3d jacobian = Eigen::Vector3d::Zero();
};

/// Rows H x + C lambda = delta, x being the displacement of the step (mm), delta the gap to close (mm). Bilateral rows
/// come first, contact rows last.
class ConstraintRows
{
public:
  /// Forget all rows; keeps the memory.
  void clear()
  {
    starts_.assign(1, 0);
    entries_.clear();
    kinds_.clear();
    gaps_.clear();
    compliances_.clear();
  }

  /// Set memory aside.
  void reserve(std::size_t n_rows, std::size_t n_entries)
  {
    starts_.reserve(n_rows + 1);
    entries_.reserve(n_entries);
    kinds_.reserve(n_rows);
    gaps_.reserve(n_rows);
    compliances_.reserve(n_rows);
  }

  /// Start a row: gap in mm, compliance in mm/N.
  void add_row(RowKind kind, double gap, double compliance)
  {
    kinds_.push_back(kind);
    gaps_.push_back(gap);
    compliances_.push_back(compliance);
    starts_.push_back(static_cast<int>(entries_.size()));
  }

  /// Add to the row started last.
  void add_entry(const RowEntry &entry)
  {
    entries_.push_back(entry);
    starts_.back() = static_cast<int>(entries_.size());
  }

  int size() const { return static_cast<int>(kinds_.size()); }
  RowKind kind(int row) const { return kinds_[row]; }
  double gap(int row) const { return gaps_[row]; }
  double compliance(int row) const { return compliances_[row]; }
  const RowEntry *begin(int row) const { return entries_.data() + starts_[row]; }
  const RowEntry *end(int row) const { return entries_.data() + starts_[row + 1]; }

private:
  std::vector<int> starts_{0};
  std::vector<RowEntry> entries_;
  std::vector<RowKind> kinds_;
  std::vector<double> gaps_;
  std::vector<double> compliances_;
};
} // namespace pelvireg::registration
