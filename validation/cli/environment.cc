#include "validation/cli/environment.h"

#include <climits>
#include <cstdlib>
#include <malloc.h>
#include <unistd.h>

namespace pelvireg::cli
{
void ensure_single_threaded_libraries(char **argv)
{
  if (std::getenv("OMP_THREAD_LIMIT") && std::getenv("OPENBLAS_NUM_THREADS"))
    return;
  constexpr int keep_what_is_set = 0;
  ::setenv("OMP_THREAD_LIMIT", "1", keep_what_is_set);
  ::setenv("OPENBLAS_NUM_THREADS", "1", keep_what_is_set);
  ::execv("/proc/self/exe", argv);
}

void keep_freed_memory()
{
  ::mallopt(M_MMAP_MAX, 0); // what is mapped for itself is always given back
  ::mallopt(M_TRIM_THRESHOLD, INT_MAX);
}
} // namespace pelvireg::cli
