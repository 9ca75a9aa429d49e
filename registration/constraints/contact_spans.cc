#include "registration/constraints/contact_spans.h"

#include <array>
#include <cstddef>

namespace pelvireg::registration
{
namespace
{
/// Nearest crossing of the other side than `inner` in steps of `stride` from `start` that bounds the other body.
const Fragment *enclosing(const std::vector<const Fragment *> &crossings, std::size_t start, int stride, int side)
{
  for (auto i = static_cast<std::ptrdiff_t>(start); i >= 0 && i < static_cast<std::ptrdiff_t>(crossings.size());
       i += stride)
    if (crossings[i]->side == side)
      return crossings[i];
  return nullptr;
}
} // namespace

bool find_spans(const std::vector<const Fragment *> &crossings, std::vector<ContactSpan> &spans)
{
  spans.clear();
  std::array<int, 2> depth_inside{0, 0};
  const Fragment *last_exit = nullptr; // set while the ray is outside both
  std::size_t overlap_start = 0;
  bool overlaps = false;
  for (std::size_t i = 0; i < crossings.size(); ++i)
  {
    const Fragment *crossing = crossings[i];
    if (!crossing->leaves && last_exit && last_exit->side != crossing->side)
      spans.push_back({crossing, last_exit, last_exit->depth - crossing->depth, nullptr, nullptr});
    depth_inside[crossing->side] += crossing->leaves ? -1 : 1;
    const bool overlapped = overlaps;
    overlaps = depth_inside[0] > 0 && depth_inside[1] > 0;
    if (overlaps && !overlapped)
      overlap_start = i;
    if (!overlaps && overlapped)
    {
      ContactSpan span{crossings[overlap_start], crossing, crossing->depth - crossings[overlap_start]->depth, nullptr,
                       nullptr};
      if (!span.is_between_bodies())
      {
        span.outer_entry = enclosing(crossings, overlap_start, -1, 1 - crossing->side);
        span.outer_exit = enclosing(crossings, i, 1, 1 - crossing->side);
      }
      spans.push_back(span);
    }
    const bool is_outside = depth_inside[0] <= 0 && depth_inside[1] <= 0;
    last_exit = is_outside && crossing->leaves ? crossing : nullptr;
  }
  if (depth_inside[0] == 0 && depth_inside[1] == 0)
    return true;
  spans.clear();
  return false;
}
} // namespace pelvireg::registration
