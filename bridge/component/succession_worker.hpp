// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "component/busy_thread.hpp"
#include "component/node_host.hpp"
#include "runtime/intervention.hpp"

namespace clew::bridge {

/// Makes and feeds those that take the place of a process's nodes while these step on, in a thread
/// of its own.
class SuccessionWorker {
 public:
  /// `last` is the plan up to the first intervention, read as the stage `reader` needs it; `make`
  /// makes nodes, and `on_fatal` takes why one cannot be made.
  SuccessionWorker(std::vector<NodeHost*> hosts, std::string reader,
                   std::shared_ptr<const runtime::RunPlan> last,
                   const std::vector<runtime::StageInfo>& stages, runtime::MakeNode make,
                   std::function<void(std::string)> on_fatal);
  /// Waits for the one at work.
  ~SuccessionWorker();
  SuccessionWorker(const SuccessionWorker&) = delete;
  SuccessionWorker& operator=(const SuccessionWorker&) = delete;

  /// The run changes at a later tick. No host begins it before its node is there.
  void take(domain::Intervention intervention);
  bool is_busy() const { return busy_.load(); }
  /// BusyThread's.
  std::uint64_t processor_ns() const { return work_.processor_ns(); }

 private:
  void work();
  void change_all_hosts(const domain::Intervention& intervention);
  core::Result<void> succeed(NodeHost& host, const domain::Intervention& intervention,
                             const std::shared_ptr<const runtime::RunPlan>& next) const;

  const std::vector<NodeHost*> hosts_;
  const std::string reader_;
  std::shared_ptr<const runtime::RunPlan> last_;
  const std::vector<runtime::StageInfo>& stages_;
  const runtime::MakeNode make_;
  const std::function<void(std::string)> on_fatal_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<domain::Intervention> waiting_;
  bool ends_ = false;
  std::atomic<bool> busy_{false};  ///< also while it has not begun yet
  BusyThread work_;
  std::thread thread_;
};

}  // namespace clew::bridge
