// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "process/journal.hpp"
#include "replay/tick_reader.hpp"
#include "runtime/node.hpp"

namespace clew::bridge {

/// A component whose inputs come from a recording. Its own recorded outputs do not matter to it,
/// with one exception: in real time drive goes on without a command that is late, and only the
/// `state` that it published then tells.
class FedNode {
 public:
  explicit FedNode(runtime::Node node) : node_(std::move(node)) {}

  const runtime::Node& node() const { return node_; }
  /// What a tick must hold to be fed.
  runtime::TopicSet fed_topics() const;

  /// Steps for the next tick, from 0. Refused: another tick than that, one without a sample of a
  /// wired input, and samples that are not valid.
  core::Result<void> step(const RecordedTick& recorded);

  /// The outputs of the last step, and its inputs as far as they were present.
  const domain::Messages& messages() const { return messages_; }
  const runtime::TopicSet& inputs_present() const { return present_; }

  /// The node, in the state after the last step.
  runtime::Node take() { return std::move(node_); }

 private:
  core::Result<void> check(const RecordedTick& recorded) const;
  core::Result<void> decode(domain::Topic topic, std::uint64_t tick, std::string_view cdr);
  core::Result<void> decode_delayed(const RecordedTick& recorded);

  runtime::Node node_;
  Codecs codecs_;
  domain::Messages messages_;
  runtime::TopicSet present_;
  std::array<std::string, domain::kTopicCount> cdr_before_;  ///< delayed inputs, of the last tick
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::bridge
