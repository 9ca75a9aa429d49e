#include "reference_fe/contact/contact_law.h"

namespace pelvireg::reference_fe
{
ContactLaw contact_law(double gap, double onset, double stiffening)
{
  if (gap >= onset)
    return {};
  const double depth = onset - gap;
  ContactLaw law = {depth * depth * depth / (12 * onset), -depth * depth / (4 * onset), depth / (2 * onset)};
  if (gap <= -onset)
    law = {0.5 * gap * gap + onset * onset / 6, gap, 1};
  if (gap < 0)
  {
    law.energy -= stiffening * gap * gap * gap / 3;
    law.d_energy -= stiffening * gap * gap;
    law.d2_energy -= 2 * stiffening * gap;
  }
  return law;
}
} // namespace pelvireg::reference_fe
