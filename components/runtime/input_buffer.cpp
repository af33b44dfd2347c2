// SPDX-License-Identifier: Apache-2.0
#include "runtime/input_buffer.hpp"

#include <utility>

namespace clew::runtime {

InputBuffer::InputBuffer(const NodePorts& ports, std::size_t depth)
    : inputs_(ports.inputs), delayed_(ports.delayed_inputs), slots_(depth) {}

InputBuffer::Slot& InputBuffer::slot_of(std::uint64_t tick) {
  std::unique_ptr<Slot>& slot = slots_[tick % slots_.size()];
  if (slot == nullptr) {
    if (spare_.empty()) spare_.push_back(std::make_unique<Slot>());
    slot = std::move(spare_.back());
    spare_.pop_back();
  }
  return *slot;
}

void InputBuffer::release(std::uint64_t tick) {
  std::unique_ptr<Slot>& slot = slots_[tick % slots_.size()];
  if (slot == nullptr) return;
  slot->present.reset();
  spare_.push_back(std::move(slot));
}

void InputBuffer::restart_at(std::uint64_t tick) {
  for (std::uint64_t t = next_tick_; t < next_tick_ + slots_.size(); ++t) {
    const bool stays = t >= tick && t - tick < slots_.size();
    if (!stays) release(t);
  }
  next_tick_ = tick;
}

TopicSet InputBuffer::needed(std::uint64_t tick) const {
  return tick == 0 ? inputs_ : inputs_ | delayed_;
}

TopicSet InputBuffer::present(std::uint64_t tick) const {
  const std::unique_ptr<Slot>& slot = slots_[tick % slots_.size()];
  return slot != nullptr ? slot->present : TopicSet();
}

bool InputBuffer::ready() const { return present(next_tick_) == needed(next_tick_); }

bool InputBuffer::rest_is_lost() const {
  TopicSet later;
  for (std::uint64_t tick = next_tick_ + 1; tick < next_tick_ + slots_.size(); ++tick) {
    later |= present(tick);
  }
  return (needed(next_tick_) & ~present(next_tick_) & ~later).none();
}

TopicSet InputBuffer::take(domain::Messages& messages) {
  Slot& slot = slot_of(next_tick_);
  const TopicSet present = slot.present;
  for (Topic topic : domain::kAllTopics) {
    if (!present[index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = index_of(decltype(constant)::value);
      std::swap(std::get<kIndex>(messages), std::get<kIndex>(slot.messages));
    });
  }
  release(next_tick_++);
  return present;
}

}  // namespace clew::runtime
