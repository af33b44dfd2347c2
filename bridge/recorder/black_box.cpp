// SPDX-License-Identifier: Apache-2.0
#include "recorder/black_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "recording/output_file.hpp"
#include "recording/run_recording.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using domain::Topic;

/// Text for an outcome other than reached; empty while running or reached.
const char* bad_end(domain::Outcome outcome) {
  switch (outcome) {
    case domain::Outcome::kCollided:
      return "the run ended with a collision";
    case domain::Outcome::kUnreachable:
      return "the target is unreachable";
    case domain::Outcome::kTimeout:
      return "the run's time is over";
    case domain::Outcome::kRunning:
    case domain::Outcome::kReached:
      break;
  }
  return "";
}

}  // namespace

Result<std::unique_ptr<BlackBox>> BlackBox::go_on(const RecordingOrder& order,
                                                  std::uint64_t least_ticks) {
  std::unique_ptr<BlackBox> box(new BlackBox(order));
  const std::string there = mcap::OutputFile::temporary_name(order.path);
  const auto holds = RunRecorder::holds_samples(there);
  if (!holds.ok()) return holds.error();
  if (!*holds) return box;
  const auto recording = RunRecording::open(there);
  if (!recording.ok()) return recording.error();
  RecordingOrder begun = order;
  begun.description.black_box = recording->description().black_box;
  auto file = RecordingSink::go_on(begun, least_ticks);
  if (!file.ok()) return file.error();
  box->file_ = std::move(file).value();
  return box;
}

BlackBox::BlackBox(RecordingOrder order)
    : order_(std::move(order)),
      keep_ticks_(
          static_cast<std::uint64_t>(std::ceil(order_.keep_last_s / order_.description.tick_s))) {}

std::uint64_t BlackBox::first_tick(std::uint64_t tick, std::uint64_t keep_ticks) {
  const std::uint64_t first = tick - std::min(tick, keep_ticks);
  return first - first % kTicksPerCheckpoint;
}

std::uint64_t BlackBox::least_tick() const {
  const std::uint64_t first = first_tick(settled_ticks_, keep_ticks_);
  return first - std::min<std::uint64_t>(first, 1);
}

Kept BlackBox::kept() const { return file_ ? file_->kept() : Kept{settled_ticks_, least_tick()}; }

Result<void> BlackBox::write_ahead() { return file_ ? file_->write_ahead() : Result<void>(); }

Result<void> BlackBox::add(const SampleView& sample) {
  if (file_) return file_->add(sample);
  const std::size_t topic = index_of(sample.topic);
  if (sample.tick < next_tick_[topic]) return {};
  next_tick_[topic] = sample.tick + 1;
  held_.emplace_back(sample);
  watch(sample);
  return settle();
}

void BlackBox::add_state(const SpooledState& state) {
  if (!file_) states_[state.tick][std::string(state.stage)] = state.state;
}

void BlackBox::add_intervention(const domain::Intervention& intervention) {
  if (file_) return file_->add_intervention(intervention);
  interventions_.push_back(intervention);
}

void BlackBox::add_incident(const domain::Incident& incident) {
  if (file_) return file_->add_incident(incident);
  incidents_.push_back(incident);
}

void BlackBox::watch(const SampleView& sample) {
  if (sample.topic == Topic::kEvent) watch_event(sample);
  if (sample.topic == Topic::kState) watch_state(sample);
}

void BlackBox::watch_event(const SampleView& sample) {
  if (!event_codec_.decode(sample.cdr, event_).ok()) return;
  for (const domain::EventEntry& entry : event_.entries) {
    if (entry.kind == domain::EventKind::kTrap && !entry.shadow) {
      return happened(sample.tick, fmt::format("{} noticed a trap", entry.rule));
    }
  }
}

void BlackBox::watch_state(const SampleView& sample) {
  if (!state_codec_.decode(sample.cdr, state_).ok()) return;
  if (contacts_ && state_.collisions > contacts_->first) happened(sample.tick, "a collision");
  if (contacts_ && state_.hit_by > contacts_->second) happened(sample.tick, "hit by an obstacle");
  if (const std::string end = bad_end(state_.outcome); !end.empty()) happened(sample.tick, end);
  contacts_ = {state_.collisions, state_.hit_by};
}

// Of several in a tick the text that sorts first: the topics come in any order.
void BlackBox::happened(std::uint64_t tick, const std::string& what) {
  const bool first = !next_ || tick < next_->tick || (tick == next_->tick && what < next_->what);
  if (first) next_ = {tick, what};
}

Result<void> BlackBox::settle() {
  std::uint64_t slowest = UINT64_MAX;
  std::uint64_t fastest = 0;
  for (const auto& [topic, schema] : order_.description.schemas) {
    slowest = std::min(slowest, next_tick_[index_of(topic)]);
    fastest = std::max(fastest, next_tick_[index_of(topic)]);
  }
  // Samples that are so late are lost: see RunRecorder.
  const std::uint64_t lost =
      fastest - std::min<std::uint64_t>(fastest, RunRecorder::kMaxWaitingTicks);
  const std::uint64_t settled = std::max(slowest, lost);
  if (settled == settled_ticks_) return {};
  settled_ticks_ = settled;
  if (next_ && next_->tick < settled_ticks_) return write(next_->tick, next_->what);
  forget();
  return {};
}

void BlackBox::forget() {
  const std::uint64_t least = least_tick();
  while (!held_.empty() && held_.front().tick < least) held_.pop_front();
  while (!states_.empty() && states_.begin()->first < least) states_.erase(states_.begin());
}

Result<void> BlackBox::write(std::uint64_t tick, const std::string& why) {
  const std::uint64_t first = first_tick(tick, keep_ticks_);
  RecordingOrder order = order_;
  order.description.black_box = {first, fmt::format("{} at tick {}", why, tick), {}};
  if (const auto at = states_.find(first); at != states_.end()) {
    order.description.black_box->states = std::move(at->second);
  }
  auto file = RecordingSink::go_on(order);
  if (!file.ok()) return file.error();
  file_ = std::move(file).value();
  for (const domain::Intervention& known : interventions_) file_->add_intervention(known);
  for (const domain::Incident& known : incidents_) file_->add_incident(known);
  for (const Sample& held : held_) {
    if (held.tick + 1 < first) continue;
    CLEW_RETURN_IF_ERROR(file_->add(held.view()));
  }
  held_.clear();
  states_.clear();
  return {};
}

RecordingAccount BlackBox::close(const RunEnding& ending) {
  RecordingAccount account;
  Result<void> written;
  if (!file_ && next_) {
    written = write(next_->tick, next_->what);
  } else if (!file_ && !ending.aborted.empty() && !held_.empty()) {
    written = write(settled_ticks_, "the run was aborted");
  }
  if (file_) account = file_->close(ending);
  account.nothing = !file_;
  if (!written.ok()) account.failure = written.error().text();
  return account;
}

}  // namespace clew::bridge
