#include "registration/kernels/kernels.h"

namespace pelvireg::registration::kernels
{
extern const Kernels kernels_portable;
#ifdef PELVIREG_X86_KERNELS
extern const Kernels kernels_avx2, kernels_avx512;
#endif

namespace
{
struct Available
{
  const Kernels *kernels[3] = {&kernels_portable};
  int n = 1;
};

Available detect()
{
  Available found;
#ifdef PELVIREG_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    found.kernels[found.n++] = &kernels_avx2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    found.kernels[found.n++] = &kernels_avx512;
#endif
  return found;
}

const Available &all()
{
  static const Available found = detect();
  return found;
}
} // namespace

int n_available()
{
  return all().n;
}

const Kernels &available(int index)
{
  return *all().kernels[index];
}

const Kernels &best()
{
  return *all().kernels[all().n - 1];
}
} // namespace pelvireg::registration::kernels
