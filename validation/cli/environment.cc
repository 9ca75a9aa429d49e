#include "validation/cli/environment.h"

#include <cstdlib>
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
} // namespace pelvireg::cli
