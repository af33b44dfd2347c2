// SPDX-License-Identifier: Apache-2.0
#include "component/succession_worker.hpp"

#include <utility>

namespace clew::bridge {

SuccessionWorker::SuccessionWorker(std::vector<NodeHost*> hosts, std::string reader,
                                   std::shared_ptr<const runtime::RunPlan> last,
                                   const std::vector<runtime::StageInfo>& stages,
                                   runtime::MakeNode make,
                                   std::function<void(std::string)> on_fatal)
    : hosts_(std::move(hosts)),
      reader_(std::move(reader)),
      last_(std::move(last)),
      stages_(stages),
      make_(std::move(make)),
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
  for (NodeHost* host : hosts_) host->expect_successor(intervention.tick);
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
    work_.begin();
    change_all_hosts(next);
    work_.end();
    lock.lock();
    busy_ = !waiting_.empty();
  }
}

void SuccessionWorker::change_all_hosts(const domain::Intervention& intervention) {
  auto plans = runtime::change_all(*last_, {intervention}, stages_, reader_);
  if (!plans.ok()) return on_fatal_(reader_ + ": " + plans.error().text());
  for (NodeHost* host : hosts_) {
    const auto succeeded = succeed(*host, intervention, plans->front());
    if (!succeeded.ok()) on_fatal_(host->name() + ": " + succeeded.error().text());
  }
  last_ = plans->front();
}

core::Result<void> SuccessionWorker::succeed(
    NodeHost& host, const domain::Intervention& intervention,
    const std::shared_ptr<const runtime::RunPlan>& next) const {
  auto successor = runtime::successor(*last_, next, intervention, host.name(), make_);
  if (successor) return host.take_successor(std::move(*successor));
  host.forget_successor(intervention.tick);
  return {};
}

}  // namespace clew::bridge
