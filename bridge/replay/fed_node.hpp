// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/result.hpp"
#include "replay/tick_reader.hpp"
#include "run/sample_account.hpp"
#include "runtime/node_succession.hpp"

namespace clew::bridge {

/// The state that a component takes over before it steps `tick`.
struct HandOver {
  std::uint64_t tick = 0;
  std::string state;  ///< runtime::Node::save
};

/// Whether the node is the one that begins each tick: drive, which is the robot.
inline bool is_robot(const runtime::NodeSuccession& node) {
  return node.ports().delayed_inputs.any();
}

/// A component whose inputs come from a recording. Its own recorded outputs do not matter to it,
/// with one exception: in real time drive goes on without a command that is late, and only the
/// `state` that it published then tells.
class FedNode {
 public:
  explicit FedNode(runtime::NodeSuccession node, std::optional<HandOver> hand_over = std::nullopt)
      : node_(std::move(node)), hand_over_(std::move(hand_over)) {}

  const runtime::NodeSuccession& node() const { return node_; }
  /// What is read of a tick.
  runtime::TopicSet fed_topics() const;
  /// What a tick must hold to be fed: all of that but the delayed inputs, which are used a tick
  /// later, if they were not late.
  runtime::TopicSet needed_topics() const { return fed_topics() & ~node_.ports().delayed_inputs; }

  /// Begins at `tick` instead of 0, in a state that was saved there, or in that of a component that
  /// is new. The tick before is fed first, and is not stepped: of it come the delayed inputs.
  core::Result<void> begin_at(std::uint64_t tick, const std::optional<std::string>& state);

  /// Steps for the next tick; false: a delayed input has ended before this tick could use it, in a
  /// recording that was cut off. Refused: another tick than the next, one without a sample of a
  /// wired input, samples that are not valid, a state handed over that is not one of the
  /// component's, and outputs that are not valid: of a state that no run comes to.
  core::Result<bool> step(const RecordedTick& recorded);

  /// The outputs of the last step, and its inputs as far as they were present.
  const domain::Messages& messages() const { return messages_; }
  /// What the component tells of the last step.
  domain::Inside inside() const { return node_.inside(next_tick_ - 1, present_, messages_); }
  /// False of a component that is new where it begins.
  bool has_past() const { return has_past_; }
  /// Whether the last tick that was fed was stepped.
  bool stepped() const { return stepped_; }
  const runtime::TopicSet& inputs_present() const { return present_; }

  /// The node, in the state after the last step.
  runtime::NodeSuccession take() { return std::move(node_); }

 private:
  core::Result<void> check(const RecordedTick& recorded) const;
  core::Result<bool> check_outputs() const;
  core::Result<void> check_present(const RecordedTick& recorded) const;
  core::Error lacks(domain::Topic topic, std::uint64_t tick) const;
  void keep_delayed(const RecordedTick& recorded);
  core::Result<void> decode(domain::Topic topic, std::uint64_t tick, std::string_view cdr);
  core::Result<bool> command_late(const RecordedTick& recorded);
  core::Result<bool> decode_delayed(const RecordedTick& recorded);

  runtime::NodeSuccession node_;
  std::optional<HandOver> hand_over_;
  Codecs codecs_;
  domain::Messages messages_;
  runtime::TopicSet present_;
  std::array<std::string, domain::kTopicCount> cdr_before_;  ///< delayed inputs, of the last tick
  runtime::TopicSet present_before_;                         ///< of them
  runtime::TopicSet ended_before_;
  std::uint64_t next_tick_ = 0;
  std::uint64_t first_tick_ = 0;  ///< that is stepped
  bool has_past_ = true;
  bool stepped_ = false;
};

}  // namespace clew::bridge
