// SPDX-License-Identifier: Apache-2.0
#include "component/succession_worker.hpp"

#include <utility>

namespace clew::bridge {

SuccessionWorker::SuccessionWorker(NodeHost& host, std::string stage,
                                   std::shared_ptr<const runtime::RunPlan> last,
                                   const std::vector<runtime::StageInfo>& stages,
                                   std::function<void(std::string)> on_fatal)
    : host_(host),
      stage_(std::move(stage)),
      last_(std::move(last)),
      stages_(stages),
      on_fatal_(std::move(on_fatal)),
      thread_([this] { work(); }) {}

SuccessionWorker::~SuccessionWorker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  arrived_.notify_one();
  thread_.join();
}

void SuccessionWorker::take(domain::Intervention intervention) {
  host_.expect_successor(intervention.tick);
  busy_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push_back(std::move(intervention));
  }
  arrived_.notify_one();
}

void SuccessionWorker::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    arrived_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const domain::Intervention next = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    const auto succeeded = succeed(next);
    if (!succeeded.ok()) on_fatal_(stage_ + ": " + succeeded.error().text());
    lock.lock();
    busy_ = !waiting_.empty();
  }
}

core::Result<void> SuccessionWorker::succeed(const domain::Intervention& intervention) {
  auto plans = runtime::change_all(*last_, {intervention}, stages_, stage_);
  if (!plans.ok()) return plans.error();
  auto next = runtime::successor(*last_, plans->front(), intervention, stage_);
  last_ = plans->front();
  if (next) return host_.take_successor(std::move(*next));
  host_.forget_successor(intervention.tick);
  return {};
}

}  // namespace clew::bridge
