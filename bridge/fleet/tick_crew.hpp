// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace clew::fleet {

/// Threads that do a number of tasks together, again and again. What a task does must not depend on
/// which thread does it, nor when.
class TickCrew {
 public:
  /// `threads` with the caller's own; at least 1.
  explicit TickCrew(unsigned threads);
  ~TickCrew();
  TickCrew(const TickCrew&) = delete;
  TickCrew& operator=(const TickCrew&) = delete;

  /// Calls task(0) to task(count - 1), each once, and waits until all have returned.
  void each(std::size_t count, const std::function<void(std::size_t)>& task);

 private:
  void work();
  void do_tasks(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable begun_;
  std::condition_variable done_;
  const std::function<void(std::size_t)>* task_ = nullptr;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t left_ = 0;  ///< tasks that have not returned
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace clew::fleet
