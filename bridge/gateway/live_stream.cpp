// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_stream.hpp"

#include <algorithm>

#include "run/sample_account.hpp"
#include "run/spool.hpp"

namespace clew::bridge {

void LiveStream::describe(const RunDescription& description, const std::string& name) {
  name_ = name;
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
  const bool whole =
      for_each_spooled(spool, {on_sample, [](const SpooledState&) {}, on_intervention});
  while (held_bytes_ > most_bytes_ && ticks_.size() > 1) forget_oldest();
  return whole;
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

std::optional<LiveStream::Tick> LiveStream::newest() const {
  return newest_complete_ ? tick_from(*newest_complete_) : std::nullopt;
}

}  // namespace clew::bridge
