// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/node.hpp"

namespace clew::runtime {

/// Collects the samples of a node's wired inputs, in whatever order they come, until a tick has all
/// of them. Holds at most `depth` ticks ahead of the next one. The few slots that are in use at a
/// time are used again and again, so that they stay in the processor's cache.
class InputBuffer {
 public:
  enum class Offer : std::uint8_t {
    kTaken,
    kKnown,  ///< of a tick that was stepped, or is here already: dropped
    kAhead   ///< more than `depth` ticks ahead: dropped, and lost to this reader
  };

  InputBuffer(const NodePorts& ports, std::size_t depth);

  /// The tick whose inputs are collected now.
  std::uint64_t next_tick() const { return next_tick_; }
  /// Goes on from `tick`, later or earlier; what is older or too far ahead of it is dropped.
  void restart_at(std::uint64_t tick);

  /// Takes a sample by swapping it with an old one.
  template <typename Message>
  Offer offer(Message& message) {
    constexpr auto kIndex = static_cast<std::size_t>(domain::topic_of<Message>());
    const std::uint64_t tick = message.stamp.tick + (delayed_[kIndex] ? 1 : 0);
    if (tick < message.stamp.tick) return Offer::kAhead;  // beyond the last number
    if (tick < next_tick_) return Offer::kKnown;
    if (tick - next_tick_ >= slots_.size()) return Offer::kAhead;
    Slot& slot = slot_of(tick);
    if (slot.present[kIndex]) return Offer::kKnown;
    std::swap(std::get<kIndex>(slot.messages), message);
    slot.present.set(kIndex);
    return Offer::kTaken;
  }

  /// Whether every input of the next tick is here. Tick 0 needs no delayed ones.
  bool ready() const;

  /// Whether the next tick's missing inputs can no longer come: of each there is a later sample,
  /// and samples of a topic come in order.
  bool rest_is_lost() const;

  /// Hands over the inputs of the next tick, present or not, and goes on to the tick after it.
  /// Returns which are present.
  TopicSet take(domain::Messages& messages);

 private:
  struct Slot {
    domain::Messages messages;
    TopicSet present;
  };
  Slot& slot_of(std::uint64_t tick);
  void release(std::uint64_t tick);
  TopicSet needed(std::uint64_t tick) const;
  TopicSet present(std::uint64_t tick) const;

  TopicSet inputs_;
  TopicSet delayed_;
  std::vector<std::unique_ptr<Slot>> slots_;  // by tick modulo their number; null: nothing is there
  std::vector<std::unique_ptr<Slot>> spare_;
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::runtime
