// Compiled with AVX2 and FMA.
#include "registration/kernels/kernels.h"

namespace pelvireg::registration::kernels
{
namespace avx2
{
constexpr int lanes = 4;
#include "registration/kernels/all_bodies.h"
} // namespace avx2

extern const Kernels kernels_avx2;
const Kernels kernels_avx2 = avx2::table("AVX2");
} // namespace pelvireg::registration::kernels
