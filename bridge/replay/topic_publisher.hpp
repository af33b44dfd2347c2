// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "core/result.hpp"
#include "dds/participant.hpp"
#include "replay/tick_reader.hpp"
#include "runtime/graph.hpp"

namespace clew::bridge {

/// Topics that are published under another name than their own.
using TopicNames = std::map<domain::Topic, std::string>;

/// The name under which a topic is published.
std::string published_name(domain::Topic topic, const TopicNames& names);

/// Puts recorded samples on the wire as the components would that wrote them: their topic, type
/// and QoS, and in USER_DATA their stage and the IDL's fingerprint.
class TopicPublisher {
 public:
  /// Creates a writer for each of `topics`, all of which `graph` writes. `participant` must outlive
  /// the publisher.
  static core::Result<TopicPublisher> create(Participant& participant, const runtime::Graph& graph,
                                             const runtime::TopicSet& topics, int history_depth,
                                             const TopicNames& names = {});

  const runtime::TopicSet& topics() const { return topics_; }

  /// Writes the samples of a tick, or goes on where it was held up. False: a slow reader holds it
  /// up; ask again with the same tick.
  core::Result<bool> write(const RecordedTick& recorded);

  /// Leaves the tick that is being written: another one follows.
  void leave_tick() { written_.reset(); }

  /// Whether every live reader has all that was written.
  bool acknowledged() const;
  /// How many samples of each topic were written.
  const std::map<domain::Topic, std::uint64_t>& samples() const { return samples_; }

 private:
  TopicPublisher() = default;

  runtime::TopicSet topics_;
  runtime::TopicSet written_;  ///< of the tick that is being written
  std::array<std::unique_ptr<SampleWriter>, domain::kTopicCount> writers_;
  std::map<domain::Topic, std::uint64_t> samples_;
};

}  // namespace clew::bridge
