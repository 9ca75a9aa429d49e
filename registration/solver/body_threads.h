// Bodies in parallel.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pelvireg::registration
{
/// Runs a task for every body on a fixed team of threads. A task writes only its own body's data, so the result does
/// not depend on the number of threads or on which thread takes which body.
class BodyThreads
{
public:
  /// n_threads >= 1, the caller's thread included.
  explicit BodyThreads(int n_threads);
  ~BodyThreads();
  BodyThreads(const BodyThreads &) = delete;
  BodyThreads &operator=(const BodyThreads &) = delete;

  /// Call task(order[k]) for every k, in that order of starting; returns when all are done. Tasks must not throw.
  void run(const std::vector<int> &order, const std::function<void(int)> &task);

private:
  void work();
  void take_tasks(std::unique_lock<std::mutex> &lock);

  std::mutex mutex_;
  std::condition_variable started_, finished_;
  const std::vector<int> *order_ = nullptr;
  const std::function<void(int)> *task_ = nullptr;
  std::size_t next_ = 0;
  std::size_t n_done_ = 0;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};
} // namespace pelvireg::registration
