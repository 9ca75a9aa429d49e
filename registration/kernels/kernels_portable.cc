// For any processor: two doubles at a time.
#include "registration/kernels/kernels.h"

namespace pelvireg::registration::kernels
{
namespace portable
{
constexpr int lanes = 2;
#include "registration/kernels/all_bodies.h"
} // namespace portable

extern const Kernels kernels_portable;
const Kernels kernels_portable = portable::table("portable");
} // namespace pelvireg::registration::kernels
