// SPDX-License-Identifier: Apache-2.0
#include "fleet/tick_crew.hpp"

namespace clew::fleet {

TickCrew::TickCrew(unsigned threads) {
  for (unsigned i = 1; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

TickCrew::~TickCrew() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void TickCrew::each(std::size_t count, const std::function<void(std::size_t)>& task) {
  if (threads_.empty()) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  task_ = &task;
  count_ = count;
  next_ = 0;
  left_ = count;
  begun_.notify_all();
  do_tasks(lock);
  done_.wait(lock, [this] { return left_ == 0; });
}

void TickCrew::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    begun_.wait(lock, [this] { return ends_ || next_ < count_; });
    if (ends_) return;
    do_tasks(lock);
  }
}

void TickCrew::do_tasks(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t i = next_++;
    const auto* task = task_;
    lock.unlock();
    (*task)(i);
    lock.lock();
    if (--left_ == 0) done_.notify_all();
  }
}

}  // namespace clew::fleet
