// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_stream.hpp"

#include <algorithm>
#include <cstdint>

#include "run/sample_account.hpp"
#include "run/spool.hpp"

namespace clew::bridge {

void LiveStream::describe(const RunDescription& description, const std::string& name,
                          std::size_t stages) {
  name_ = name;
  stages_ = stages;
  description_ = description;
  topics_ = description.schemas.size();
  for (StreamFollower* follower : followers_) follower->begin();
}

bool LiveStream::add(std::string_view spool) {
  const auto on_sample = [this](const SampleView& sample) {
    // A component that was restarted writes again what it has written.
    std::uint64_t& next = next_of_[sample.topic];
    if (sample.tick < next) return;
    next = sample.tick + 1;
    HeldTick& tick = ticks_[sample.tick];
    const std::size_t before = tick.records.size();
    append_to_spool(sample, tick.records);
    held_bytes_ += tick.records.size() - before;
    ++tick.samples;
    if (complete(tick) && (!newest_complete_ || sample.tick > *newest_complete_)) {
      newest_complete_ = sample.tick;
    }
  };
  const auto on_intervention = [this](const domain::Intervention& intervention) {
    interventions_.push_back(intervention);
  };
  const auto on_state = [this](const SpooledState& state) {
    std::string& held = states_[state.tick][std::string(state.stage)];
    state_bytes_ += state.state.size() - held.size();
    held = state.state;
  };
  const auto on_incident = [this](const domain::Incident& incident) {
    incidents_.push_back(incident);
  };
  const bool whole = for_each_spooled(spool, {on_sample, on_state, on_intervention, on_incident});
  while (held_bytes_ > most_bytes_ / 4 * 3 && ticks_.size() > 1) forget_oldest();
  while (state_bytes_ > most_bytes_ / 4 && states_.size() > 1) forget_states();
  return whole;
}

void LiveStream::forget_states() {
  const auto oldest = states_.begin();
  for (const auto& [stage, state] : oldest->second) state_bytes_ -= state.size();
  states_.erase(oldest);
}

void LiveStream::forget_oldest() {
  const auto oldest = ticks_.begin();
  held_bytes_ -= oldest->second.records.size();
  ticks_.erase(oldest);
}

void LiveStream::end(const std::string& how) {
  ended_ = how;
  for (StreamFollower* follower : followers_) follower->end();
}

void LiveStream::pass_on() {
  for (StreamFollower* follower : followers_) follower->pass_on();
}

std::uint64_t LiveStream::progress() const {
  std::uint64_t sum = 0;
  for (const StreamFollower* follower : followers_) sum += follower->progress();
  return sum;
}

bool LiveStream::idle() const {
  return std::all_of(followers_.begin(), followers_.end(),
                     [](const StreamFollower* follower) { return follower->idle(); });
}

std::optional<LiveStream::Tick> LiveStream::tick_from(std::uint64_t number) const {
  for (auto tick = ticks_.lower_bound(number); tick != ticks_.end(); ++tick) {
    if (complete(tick->second)) return Tick{tick->first, &tick->second.records};
    // One that has lost samples is passed over once a later one is whole.
    if (!newest_complete_ || tick->first > *newest_complete_) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> LiveStream::unbroken_until(std::uint64_t last) const {
  std::optional<std::uint64_t> first;
  auto tick = ticks_.find(last);
  for (std::uint64_t number = last; tick != ticks_.end() && tick->first == number; --number) {
    if (!complete(tick->second)) break;
    first = number;
    if (tick == ticks_.begin()) break;
    --tick;
  }
  return first;
}

bool LiveStream::is_changing(std::uint64_t tick, std::uint64_t last) const {
  return std::any_of(interventions_.begin(), interventions_.end(), [&](const auto& each) {
    return each.tick <= last && !each.changes.empty() && each.fed_from < tick && tick <= each.tick;
  });
}

// A component hands over its state before what it then writes: where a tick is whole, the states
// before it are there, too.
std::optional<LiveStream::Start> LiveStream::start_before(std::uint64_t tick) const {
  const auto first = unbroken_until(tick);
  if (!first) return std::nullopt;
  for (auto at = states_.upper_bound(tick); at != states_.begin();) {
    --at;
    if (at->first <= *first) break;  // what is taken a tick later comes from the tick before
    if (is_changing(at->first, tick)) continue;
    if (stages_ > 0 && at->second.size() == stages_) return Start{at->first, at->second};
  }
  return *first == 0 ? std::optional(Start{}) : std::nullopt;
}

std::optional<LiveStream::Tick> LiveStream::newest() const {
  return newest_complete_ ? tick_from(*newest_complete_) : std::nullopt;
}

}  // namespace clew::bridge
