// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "dds/participant.hpp"

namespace clew::bridge {

/// Writes at once, or, when that would block, from a thread of its own: the vendor's threads must
/// not wait for acknowledgements that only they can take in.
class PatientWriter {
 public:
  explicit PatientWriter(SampleWriter& writer) : writer_(writer), thread_([this] { run(); }) {}
  ~PatientWriter() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  PatientWriter(const PatientWriter&) = delete;
  PatientWriter& operator=(const PatientWriter&) = delete;

  void write(std::string_view cdr) {
    const std::lock_guard lock(mutex_);
    if (backlog_.empty() && writer_.write(cdr) == WriteStatus::kTaken) return;
    backlog_.emplace_back(cdr);
    changed_.notify_one();
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return stop_ || !backlog_.empty(); });
      if (stop_) return;
      if (writer_.write(backlog_.front()) == WriteStatus::kTaken) {
        backlog_.pop_front();
      } else {
        changed_.wait_for(lock, std::chrono::milliseconds(1), [&] { return stop_; });
      }
    }
  }

  SampleWriter& writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> backlog_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace clew::bridge
