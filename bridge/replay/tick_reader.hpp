// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "runtime/component.hpp"

namespace clew::bridge {

/// The samples that a recording has of one tick.
class RecordedTick {
 public:
  std::uint64_t tick() const { return tick_; }
  const runtime::TopicSet& present() const { return present_; }
  /// Topics without a sample of this tick or a later one, in a recording that was cut off or whose
  /// run was aborted. In any other one a topic that is not present was lost.
  const runtime::TopicSet& ended() const { return ended_; }
  bool has(domain::Topic topic) const { return present_[index_of(topic)]; }
  /// The serialised sample of a topic that is present.
  std::string_view cdr(domain::Topic topic) const { return cdr_[index_of(topic)]; }

 private:
  friend class TickReader;
  std::uint64_t tick_ = 0;
  runtime::TopicSet present_;
  runtime::TopicSet ended_;
  std::array<std::string, domain::kTopicCount> cdr_;
};

/// Reads some topics of a recording, which must live longer, tick by tick. Samples are copied,
/// never decoded.
class TickReader {
 public:
  TickReader(const RunRecording& recording, const runtime::TopicSet& topics,
             std::uint64_t last_tick = std::numeric_limits<std::uint64_t>::max(),
             std::uint64_t first_tick = 0);

  /// Ticks that lack only these are read, too, where the topics have ended.
  void let_end(const runtime::TopicSet& topics) { may_end_ = topics; }

  /// The next tick with a sample, valid until the next call; null at the end, which is where the
  /// first topic has ended. Refused: a changed byte, and samples that are not in canonical order.
  core::Result<const RecordedTick*> next();

 private:
  core::Result<void> look_ahead();
  core::Result<void> note_ended();
  core::Error not_in_order() const;

  const RunRecording& recording_;
  bool cut_off_;
  runtime::TopicSet topics_;
  runtime::TopicSet may_end_;
  SampleStream stream_;
  bool started_ = false;
  std::optional<SampleView> ahead_;
  RecordedTick current_;
};

}  // namespace clew::bridge
