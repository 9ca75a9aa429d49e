#include "synthetic/dataset/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace pelvireg::dataset
{
void for_each_index(int n, int n_threads, const std::function<void(int)> &job)
{
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(n, 0)));
  std::atomic<int> next{0};
  std::atomic<bool> has_failed{false};
  const auto work = [&]
  {
    // Whoever takes an index runs it: so all indices before one that failed were run.
    while (!has_failed)
    {
      const int i = next++;
      if (i >= n)
        return;
      try
      {
        job(i);
      }
      catch (const std::exception &)
      {
        failures[static_cast<std::size_t>(i)] = std::current_exception();
        has_failed = true;
      }
    }
  };
  std::vector<std::thread> helpers;
  for (int t = 1; t < std::min(n_threads, n); ++t)
    helpers.emplace_back(work);
  work();
  for (std::thread &helper : helpers)
    helper.join();
  for (const std::exception_ptr &failure : failures)
    if (failure)
      std::rethrow_exception(failure);
}
} // namespace pelvireg::dataset
