// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "domain/topics.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_description.hpp"
#include "recording/sample_queue.hpp"

namespace clew::bridge {

struct RecorderOptions {
  bool overwrite = false;
  mcap::Compression compression = mcap::Compression::kNone;
};

/// Writes the recording of a run: an MCAP file with the run's description in front, then its
/// samples in canonical order (tick, topic, sequence), whatever the order in which the topics
/// deliver them. A chunk holds one second of simulated time. The same run gives the same bytes.
class RunRecorder {
 public:
  /// Errors are those of the file: see mcap::OutputFile.
  static core::Result<RunRecorder> create(const std::string& path,
                                          const RunDescription& description,
                                          const RecorderOptions& options);

  /// Takes a sample and writes what has become complete. Refused: a topic that the description does
  /// not have, a tick that does not follow the topic's last one, a topic that begins at another
  /// tick than the first did, one that is kMaxWaitingTicks ahead of another, and what the file
  /// refuses.
  core::Result<void> add(domain::Topic topic, std::uint64_t tick, std::uint64_t sequence,
                         std::string_view cdr);

  /// Ticks below this one have a sample of every topic.
  std::uint64_t complete_ticks() const { return complete_ticks_; }

  /// Writes what is still waiting (of a run that was cut off), the run's end and the index, and
  /// gives the file its name. Nothing may follow.
  core::Result<void> finish();

  /// By topic, of what was written so far; topics without a sample are left out.
  std::map<std::string, core::Hash128> chains() const;

  static constexpr std::size_t kMaxWaitingTicks = 1 << 16;

 private:
  struct RecordedTopic {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint16_t channel_id = 0;
    SampleQueue waiting;
    std::optional<std::uint64_t> last_tick;  ///< that was added
    bool written = false;
    core::HashChain chain;
  };

  RunRecorder(mcap::McapWriter writer, double tick_s);
  core::Result<void> check(const RecordedTopic& recorded, std::uint64_t tick,
                           std::uint64_t sequence) const;
  void declare_topics(const std::map<domain::Topic, std::string>& schemas);
  bool every_topic_waits() const;
  bool any_topic_waits() const;
  core::Result<void> write_tick();
  core::Result<void> write_front(RecordedTopic& topic);

  mcap::McapWriter writer_;
  double tick_s_;
  std::vector<RecordedTopic> topics_;              ///< in the order of their names
  std::array<int, domain::kTopicCount> places_{};  ///< in topics_, by domain::Topic; -1: none
  std::optional<std::uint64_t> first_tick_;
  std::uint64_t complete_ticks_ = 0;
};

}  // namespace clew::bridge
