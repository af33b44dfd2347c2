// SPDX-License-Identifier: Apache-2.0
#include "component/process_host.hpp"

#include <algorithm>
#include <utility>

#include "core/archive.hpp"

namespace clew::bridge {

Checkpoint pack_checkpoints(std::uint64_t tick, const std::map<std::string, Checkpoint>& by_stage) {
  core::StateWriter writer;
  writer(by_stage);
  return {tick, writer.take(), {}, {}};
}

core::Result<std::map<std::string, Checkpoint>> unpack_checkpoints(const Checkpoint& packed) {
  std::map<std::string, Checkpoint> by_stage;
  core::StateReader reader(packed.node);
  reader(by_stage);
  if (!reader.complete()) return core::Error{"the checkpoint of the group is not one"};
  return by_stage;
}

ProcessHost::ProcessHost(std::vector<runtime::NodeSuccession> nodes, const Assignment& assignment,
                         const runtime::RunPlan& plan, NodeHost::Handlers handlers)
    : handlers_(std::move(handlers)), progress_(nodes.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    names_.push_back(nodes[i].name());
    hosts_.push_back(
        std::make_unique<NodeHost>(std::move(nodes[i]), assignment, plan, handlers_of(i)));
    if (hosts_.back()->starts_ticks()) starter_ = hosts_.back().get();
  }
}

void ProcessHost::keep_inputs(const std::map<std::string, std::string>& files) {
  for (const auto& host : hosts_) {
    const auto file = files.find(host->name());
    if (file == files.end()) continue;
    auto history = InputHistory::open(file->second);
    if (history.ok()) {
      host->keep_inputs(std::move(history).value());
    } else {
      handlers_.on_notice(history.error().text());
    }
  }
}

NodeHost::Handlers ProcessHost::handlers_of(std::size_t index) {
  return {handlers_.on_notice,
          handlers_.on_fatal,
          [this, index](const Progress& progress) { take_progress(index, progress); },
          [this, index](const Checkpoint& checkpoint) { take_checkpoint(index, checkpoint); },
          handlers_.on_spooled,
          handlers_.on_took_over,
          handlers_.on_incident};
}

void ProcessHost::take_progress(std::size_t index, const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_[index] = progress;
  Progress all;
  all.ticks = progress_.front().ticks;
  for (const Progress& one : progress_) {
    all.ticks = std::min(all.ticks, one.ticks);
    all.most_ticks = std::max(all.most_ticks, one.ticks);
    all.statistics.merge(one.statistics);
    all.refused_samples += one.refused_samples;
  }
  handlers_.on_progress(all);
}

void ProcessHost::take_checkpoint(std::size_t index, const Checkpoint& checkpoint) {
  if (hosts_.size() == 1) return handlers_.on_checkpoint(checkpoint);
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& by_stage = checkpoints_[checkpoint.tick];
  by_stage.emplace(names_[index], checkpoint);
  if (by_stage.size() < hosts_.size()) return;
  handlers_.on_checkpoint(pack_checkpoints(checkpoint.tick, by_stage));
  checkpoints_.erase(checkpoint.tick);
}

core::Result<std::vector<Checkpoint>> ProcessHost::unpack(const Checkpoint& checkpoint) const {
  if (hosts_.size() == 1) return std::vector<Checkpoint>{checkpoint};
  const auto by_stage = unpack_checkpoints(checkpoint);
  if (!by_stage.ok()) return by_stage.error();
  std::vector<Checkpoint> in_order;
  for (const std::string& name : names_) {
    const auto found = by_stage->find(name);
    if (found == by_stage->end()) {
      return core::Error{"the checkpoint of the group has none of " + name};
    }
    in_order.push_back(found->second);
  }
  return in_order;
}

core::Result<void> ProcessHost::open(Participant& participant, const StartBarrier& barrier) {
  for (const auto& host : hosts_) CLEW_RETURN_IF_ERROR(host->open(participant, barrier));
  return {};
}

core::Result<void> ProcessHost::restore(const Checkpoint& checkpoint) {
  const auto parts = unpack(checkpoint);
  if (!parts.ok()) return parts.error();
  for (std::size_t i = 0; i < hosts_.size(); ++i) {
    CLEW_RETURN_IF_ERROR(hosts_[i]->restore((*parts)[i]));
  }
  return {};
}

core::Result<void> ProcessHost::repeat_last_outputs(const Checkpoint& checkpoint) {
  const auto parts = unpack(checkpoint);
  if (!parts.ok()) return parts.error();
  for (std::size_t i = 0; i < hosts_.size(); ++i) hosts_[i]->repeat_last_outputs((*parts)[i]);
  return {};
}

void ProcessHost::go(Time now) {
  for (const auto& host : hosts_) host->go(now);
}

std::uint64_t ProcessHost::hold(std::uint64_t tick) {
  return starter_ == nullptr ? tick : starter_->hold(tick);
}

void ProcessHost::release(Time now) {
  if (starter_ != nullptr) starter_->release(now);
}

void ProcessHost::set_pace(double factor, Time now) {
  if (starter_ != nullptr) starter_->set_pace(factor, now);
}

void ProcessHost::rest() {
  if (starter_ != nullptr) starter_->rest();
}

void ProcessHost::slow(bool slowly) {
  if (starter_ != nullptr) starter_->slow(slowly);
}

bool ProcessHost::has_come_to_rest() const {
  return starter_ != nullptr && starter_->has_come_to_rest();
}

void ProcessHost::allow_until(std::uint64_t tick) {
  for (const auto& host : hosts_) host->allow_until(tick);
}

void ProcessHost::poll(Time now) {
  for (const auto& host : hosts_) host->poll(now);
}

std::optional<ProcessHost::Time> ProcessHost::next_due() const {
  std::optional<Time> next;
  for (const auto& host : hosts_) {
    const auto due = host->next_due();
    if (due && (!next || *due < *next)) next = due;
  }
  return next;
}

bool ProcessHost::is_stepping() const {
  return std::any_of(hosts_.begin(), hosts_.end(),
                     [](const auto& host) { return host->is_stepping(); });
}

std::uint64_t ProcessHost::processor_ns() const {
  std::uint64_t all = 0;
  for (const auto& host : hosts_) all += host->processor_ns();
  return all;
}

std::map<std::string, StepTimes> ProcessHost::step_times() const {
  std::map<std::string, StepTimes> times;
  for (const auto& host : hosts_) times.emplace(host->name(), host->step_times());
  return times;
}

void ProcessHost::flush() {
  for (const auto& host : hosts_) host->flush();
}

void ProcessHost::spool() {
  for (const auto& host : hosts_) host->spool();
}

std::vector<NodeHost*> ProcessHost::stages() const {
  std::vector<NodeHost*> stages;
  for (const auto& host : hosts_) stages.push_back(host.get());
  return stages;
}

std::optional<Finished> ProcessHost::finished(std::uint64_t last_tick) const {
  Finished all;
  for (const auto& host : hosts_) {
    auto one = host->finished(last_tick);
    if (!one) return std::nullopt;
    all.chains.merge(one->chains);
    all.statistics.merge(one->statistics);
    all.refused_samples += one->refused_samples;
  }
  return all;
}

}  // namespace clew::bridge
