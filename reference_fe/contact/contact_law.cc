#include "reference_fe/contact/contact_law.h"

namespace pelvireg::reference_fe
{
ContactLaw contact_law(double gap, double onset)
{
  if (gap >= onset)
    return {};
  if (gap <= -onset)
    return {0.5 * gap * gap + onset * onset / 6, gap, 1};
  const double depth = onset - gap;
  return {depth * depth * depth / (12 * onset), -depth * depth / (4 * onset), depth / (2 * onset)};
}
} // namespace pelvireg::reference_fe
