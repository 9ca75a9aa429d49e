// Where two bodies overlap or nearly touch along one ray.
#pragma once

#include "registration/constraints/layered_depth_image.h"

#include <vector>

namespace pelvireg::registration
{
/// A stretch of a ray between the entry into one body and the exit from the other, or from the same one.
struct ContactSpan
{
  const Fragment *entry = nullptr;
  const Fragment *exit = nullptr;
  /// exit depth - entry depth, mm: length of the overlap; negative: a gap between two bodies, by its length.
  double length = 0;
  /// For an overlap that one body starts and ends (it lies inside the other one here): the other body's crossings
  /// around it. Null otherwise.
  const Fragment *outer_entry = nullptr, *outer_exit = nullptr;

  bool is_between_bodies() const { return entry->side != exit->side; }
};

/// Overlaps and gaps along a ray, ascending, into `spans`. Both surfaces are closed, so the ray must have entered each
/// as often as it left it: false, and no span, when it has not. Inside is where a surface is entered more often than
/// left (surfaces may cut themselves). Gaps are those that no third crossing interrupts, of any length.
bool find_spans(const std::vector<const Fragment *> &crossings, std::vector<ContactSpan> &spans);
} // namespace pelvireg::registration
