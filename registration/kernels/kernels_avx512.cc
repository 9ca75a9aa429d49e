// Compiled with AVX-512.
#include "registration/kernels/kernels.h"

namespace pelvireg::registration::kernels
{
namespace avx512
{
constexpr int lanes = 8;
#include "registration/kernels/all_bodies.h"
} // namespace avx512

extern const Kernels kernels_avx512;
const Kernels kernels_avx512 = avx512::table("AVX-512");
} // namespace pelvireg::registration::kernels
