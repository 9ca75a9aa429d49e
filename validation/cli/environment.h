// What has to hold before any work is done.
#pragma once

namespace pelvireg::cli
{
/// CHOLMOD and OpenBLAS read their thread limits when they are loaded and would open a team of threads inside each of
/// ours. When OMP_THREAD_LIMIT or OPENBLAS_NUM_THREADS is not set, set both to 1 and start the program anew; returns
/// when they are set or when the system refuses to start it.
void ensure_single_threaded_libraries(char **argv);
} // namespace pelvireg::cli
