#include "validation/report/colour_map.h"

#include <algorithm>
#include <cstddef>

namespace pelvireg::report
{
Colour viridis_at(double share)
{
  const double place = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  Colour colour;
  for (std::size_t k = 0; k < colour.size(); ++k)
    colour[k] = viridis[lower][k] + (place - static_cast<double>(lower)) * (viridis[lower + 1][k] - viridis[lower][k]);
  return colour;
}
} // namespace pelvireg::report
