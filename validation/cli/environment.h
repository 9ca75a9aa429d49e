// What has to hold before any work is done.
#pragma once

namespace pelvireg::cli
{
/// CHOLMOD and OpenBLAS read their thread limits when they are loaded and would open a team of threads inside each of
/// ours. When OMP_THREAD_LIMIT or OPENBLAS_NUM_THREADS is not set, set both to 1 and start the program anew; returns
/// when they are set or when the system refuses to start it.
void ensure_single_threaded_libraries(char **argv);

/// From here on keep freed memory for what is allocated next, instead of giving it back to the system. Each of the
/// reference's factorisations takes half a gigabyte, a hundred times over: new pages for it cost a tenth of its time.
void keep_freed_memory();
} // namespace pelvireg::cli
