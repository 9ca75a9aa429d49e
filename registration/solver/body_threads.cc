#include "registration/solver/body_threads.h"

namespace pelvireg::registration
{
BodyThreads::BodyThreads(int n_threads)
{
  for (int i = 1; i < n_threads; ++i)
    threads_.emplace_back([this] { work(); });
}

BodyThreads::~BodyThreads()
{
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  started_.notify_all();
  for (std::thread &thread : threads_)
    thread.join();
}

void BodyThreads::run(const std::vector<int> &order, const std::function<void(int)> &task)
{
  std::unique_lock lock(mutex_);
  order_ = &order;
  task_ = &task;
  next_ = 0;
  n_done_ = 0;
  started_.notify_all();
  take_tasks(lock);
  finished_.wait(lock, [this] { return n_done_ == order_->size(); });
  order_ = nullptr;
}

void BodyThreads::work()
{
  std::unique_lock lock(mutex_);
  while (true)
  {
    started_.wait(lock, [this] { return stop_ || (order_ && next_ < order_->size()); });
    if (stop_)
      return;
    take_tasks(lock);
  }
}

void BodyThreads::take_tasks(std::unique_lock<std::mutex> &lock)
{
  while (order_ && next_ < order_->size())
  {
    const int body = (*order_)[next_++];
    const std::function<void(int)> &task = *task_;
    lock.unlock();
    task(body);
    lock.lock();
    if (++n_done_ == order_->size())
      finished_.notify_all();
  }
}
} // namespace pelvireg::registration
