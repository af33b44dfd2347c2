// SPDX-License-Identifier: Apache-2.0
#include "replay/fed_node.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

core::Error refused(const std::string& what) { return {what}; }

std::string sample_of(Topic topic, std::uint64_t tick) {
  return "sample of '" + std::string(domain::topic_name(topic)) + "' of tick " +
         std::to_string(tick);
}

core::Error bad_sample(Topic topic, std::uint64_t tick, const core::Error& error) {
  return refused("holds a bad " + sample_of(topic, tick) + ": " + error.message);
}

}  // namespace

runtime::TopicSet FedNode::fed_topics() const {
  runtime::TopicSet topics = node_.ports().all_inputs();
  if (is_robot(node_)) topics.set(index_of(Topic::kState));
  return topics;
}

core::Result<void> FedNode::check(const RecordedTick& recorded) const {
  if (recorded.tick() != next_tick_) {
    return refused("has no sample of tick " + std::to_string(next_tick_) + " for " + node_.name() +
                   "; the next is of tick " + std::to_string(recorded.tick()));
  }
  return check_present(recorded);
}

core::Result<void> FedNode::check_present(const RecordedTick& recorded) const {
  const runtime::TopicSet missing = needed_topics() & ~recorded.present();
  for (Topic topic : domain::kAllTopics) {
    if (missing[index_of(topic)]) return lacks(topic, recorded.tick());
  }
  return {};
}

core::Error FedNode::lacks(Topic topic, std::uint64_t tick) const {
  return refused("has no " + sample_of(topic, tick) + ", which " + node_.name() + " needs");
}

core::Result<void> FedNode::decode(Topic topic, std::uint64_t tick, std::string_view cdr) {
  core::Result<void> decoded;
  domain::visit_topic(topic, [&](auto constant) {
    decoded = std::get<constant.kIndex>(codecs_).decode(cdr, std::get<constant.kIndex>(messages_));
  });
  if (decoded.ok()) return decoded;
  return bad_sample(topic, tick, decoded.error());
}

// `state` is drive's own output: what else it says is compared, not relied on.
core::Result<bool> FedNode::command_late(const RecordedTick& recorded) {
  auto& state = std::get<domain::State>(messages_);
  const auto decoded = std::get<index_of(Topic::kState)>(codecs_).decode_unvalidated(
      recorded.cdr(Topic::kState), state);
  if (!decoded.ok()) return bad_sample(Topic::kState, recorded.tick(), decoded.error());
  return state.command_late;
}

/// Takes up the inputs of the tick before, unless they were late; those of this tick are kept.
/// False: one has ended.
core::Result<bool> FedNode::decode_delayed(const RecordedTick& recorded) {
  const runtime::TopicSet& delayed = node_.ports().delayed_inputs;
  if (delayed.none()) return true;
  const auto late = command_late(recorded);
  if (!late.ok()) return late.error();
  for (Topic topic : domain::kAllTopics) {
    const std::size_t index = index_of(topic);
    if (!delayed[index] || recorded.tick() == 0 || *late) continue;
    if (ended_before_[index]) return false;
    if (!present_before_[index]) return lacks(topic, recorded.tick() - 1);
    CLEW_RETURN_IF_ERROR(decode(topic, recorded.tick() - 1, cdr_before_[index]));
    present_.set(index);
  }
  keep_delayed(recorded);
  return true;
}

void FedNode::keep_delayed(const RecordedTick& recorded) {
  present_before_ = recorded.present();
  ended_before_ = recorded.ended();
  for (Topic topic : domain::kAllTopics) {
    if (!node_.ports().delayed_inputs[index_of(topic)] || !recorded.has(topic)) continue;
    cdr_before_[index_of(topic)].assign(recorded.cdr(topic));
  }
}

core::Result<void> FedNode::begin_at(std::uint64_t tick, const std::optional<std::string>& state) {
  first_tick_ = tick;
  next_tick_ = tick;
  if (state) return node_.load(*state);
  node_.begin_at(tick);
  has_past_ = false;
  return {};
}

core::Result<bool> FedNode::step(const RecordedTick& recorded) {
  stepped_ = next_tick_ > first_tick_ || recorded.tick() + 1 != first_tick_;
  if (!stepped_) {
    CLEW_RETURN_IF_ERROR(check_present(recorded));
    keep_delayed(recorded);
    return true;
  }
  CLEW_RETURN_IF_ERROR(check(recorded));
  present_ = node_.ports().inputs;
  const auto delayed = decode_delayed(recorded);
  if (!delayed.ok() || !*delayed) return delayed;
  for (Topic topic : domain::kAllTopics) {
    if (!node_.ports().inputs[index_of(topic)]) continue;
    CLEW_RETURN_IF_ERROR(decode(topic, recorded.tick(), recorded.cdr(topic)));
  }
  if (hand_over_ && hand_over_->tick == next_tick_) {
    CLEW_RETURN_IF_ERROR(node_.load(hand_over_->state));
  }
  node_.step(next_tick_, present_, messages_);
  ++next_tick_;
  return check_outputs();
}

// A component writes what is valid, if its state is one that it came to by itself.
core::Result<bool> FedNode::check_outputs() const {
  for (Topic topic : node_.ports().output_order) {
    const auto valid = domain::visit_topic(topic, [&](auto constant) {
      return domain::validate(std::get<constant.kIndex>(messages_));
    });
    if (valid.ok()) continue;
    return refused("brings " + node_.name() + " to write a bad " +
                   sample_of(topic, next_tick_ - 1) + ": " + valid.error().message);
  }
  return true;
}

}  // namespace clew::bridge
