// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recorder/recording_sink.hpp"
#include "runtime/component.hpp"

namespace clew::bridge {

/// Keeps the last seconds of a run in memory, and writes them when a trap is detected, a collision
/// happens or the run ends badly; from there on it records all. What it writes can be replayed: it
/// begins at a checkpoint, and holds the components' states there.
///
/// Which samples are in the file follows from the run alone, not from the order in which its
/// components deliver them: what happens in a tick counts when every topic has delivered it.
class BlackBox : public RunSink {
 public:
  /// As open_sink: goes on writing a file that holds samples, else waits for something to happen.
  static core::Result<std::unique_ptr<BlackBox>> go_on(const RecordingOrder& order,
                                                       std::uint64_t least_ticks);

  core::Result<void> add(const SampleView& sample) override;
  bool wants_states() const override { return !file_; }
  void add_state(const SpooledState& state) override;
  void add_intervention(const domain::Intervention& intervention) override;
  void add_incident(const domain::Incident& incident) override;
  core::Result<void> write_ahead() override;
  /// Before it writes: what is kept may be forgotten when it can no longer get into the file.
  Kept kept() const override;
  RecordingAccount close(const RunEnding& ending) override;

  /// The first tick that a box holds in full which something at `tick` makes write, `keep_ticks`
  /// before it: the checkpoint at or before that.
  static std::uint64_t first_tick(std::uint64_t tick, std::uint64_t keep_ticks);

 private:
  struct Happening {
    std::uint64_t tick = 0;
    std::string what;
  };

  explicit BlackBox(RecordingOrder order);
  void watch(const SampleView& sample);
  void watch_event(const SampleView& sample);
  void watch_state(const SampleView& sample);
  void happened(std::uint64_t tick, const std::string& what);
  core::Result<void> settle();
  core::Result<void> write(std::uint64_t tick, const std::string& why);
  void forget();
  /// Samples of ticks below this one cannot get into the file any more.
  std::uint64_t least_tick() const;

  RecordingOrder order_;
  std::uint64_t keep_ticks_;
  std::array<std::uint64_t, domain::kTopicCount> next_tick_{};  ///< of each topic of the run
  std::uint64_t settled_ticks_ = 0;  ///< below this one every topic has delivered
  std::deque<Sample> held_;          ///< in the order of arrival
  std::map<std::uint64_t, std::map<std::string, std::string>> states_;  ///< by tick and stage
  std::vector<domain::Intervention> interventions_;
  std::vector<domain::Incident> incidents_;
  std::optional<Happening> next_;  ///< the earliest that has not settled
  std::optional<std::pair<std::uint32_t, std::uint32_t>> contacts_;  ///< made, and suffered
  Codec<domain::Event> event_codec_;
  Codec<domain::State> state_codec_;
  domain::Event event_;
  domain::State state_;
  std::unique_ptr<RecordingSink> file_;  ///< once something has happened
};

}  // namespace clew::bridge
