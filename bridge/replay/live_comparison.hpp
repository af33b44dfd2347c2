// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "component/start_barrier.hpp"
#include "core/result.hpp"
#include "dds/participant.hpp"
#include "replay/component_replay.hpp"
#include "replay/tick_reader.hpp"
#include "wire/sample.hpp"

namespace clew::bridge {

/// What a replay is called on the wire.
inline constexpr const char* kReplayName = "replay";

/// Reads what a component writes on the wire and compares it with what was recorded, tick by tick.
class LiveComparison {
 public:
  /// Ticks before `first_compared` are only counted. `on_arrival` is called on the vendor's threads
  /// when a sample has come.
  LiveComparison(std::string component, const runtime::NodePorts& ports,
                 std::uint64_t first_compared, std::function<void()> on_arrival);
  ~LiveComparison();
  LiveComparison(const LiveComparison&) = delete;
  LiveComparison& operator=(const LiveComparison&) = delete;

  /// Creates the readers. Both arguments must outlive the comparison.
  core::Result<void> open(Participant& participant, const StartBarrier& barrier, int history_depth);

  /// What a recorded tick must hold to be compared and explained.
  runtime::TopicSet topics() const { return ports_.all_inputs() | ports_.outputs; }
  /// The component is about to be fed a tick.
  void expect(const RecordedTick& recorded);
  /// Compares the ticks whose outputs are all here. Refused: a sample that is not valid.
  core::Result<void> compare();

  /// Ticks expected and not yet compared.
  std::size_t outstanding() const { return expected_.size(); }
  /// The oldest of them; with none, the one after the last.
  std::uint64_t next_tick() const;
  const ReplayReport& report() const { return report_; }

 private:
  template <typename Message>
  class Output;
  struct ExpectedTick {
    RecordedTick recorded;
    runtime::TopicSet arrived;
    std::array<std::string, domain::kTopicCount> cdr;
  };

  void arrive(const SampleView& sample);
  void refuse(domain::Topic topic, const core::Error& error);
  void compare_tick(const ExpectedTick& expected);
  void list_inputs(const RecordedTick& recorded);

  const runtime::NodePorts ports_;
  const std::uint64_t first_compared_;
  const std::function<void()> on_arrival_;
  ReplayReport report_;
  SampleComparison comparison_;
  Codecs codecs_;
  domain::Messages messages_;
  std::deque<ExpectedTick> expected_;
  std::uint64_t end_tick_ = 0;                               ///< after the last one expected
  std::array<std::string, domain::kTopicCount> cdr_before_;  ///< inputs of the tick compared last

  std::mutex mutex_;  ///< of what the vendor's threads write
  std::vector<Sample> arrivals_;
  std::string refused_;
  std::vector<std::unique_ptr<SampleListener>> listeners_;
  std::vector<std::unique_ptr<SampleReader>> readers_;  // closed before the listeners go
};

}  // namespace clew::bridge
