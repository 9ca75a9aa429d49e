// Independent jobs on several threads.
#pragma once

#include <functional>

namespace pelvireg::dataset
{
/// Call job(0) … job(n - 1), each once, on at most n_threads threads; they are begun in ascending order. Jobs write to
/// places of their own, so the result does not depend on n_threads. When a job throws, those that have begun end, no
/// other is begun, and the exception of the first index that failed is thrown: the same for every n_threads.
void for_each_index(int n, int n_threads, const std::function<void(int)> &job);
} // namespace pelvireg::dataset
