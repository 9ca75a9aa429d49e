// Independent jobs on several threads.
#pragma once

#include <functional>

namespace pelvireg::runner
{
/// Call job(0) … job(n - 1), each once, on at most n_threads threads. Jobs write to places of their own, so the result
/// does not depend on n_threads. When jobs throw, all others still run and the exception of the first index is thrown.
void for_each_index(int n, int n_threads, const std::function<void(int)> &job);
} // namespace pelvireg::runner
