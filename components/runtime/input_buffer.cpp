// SPDX-License-Identifier: Apache-2.0
#include "runtime/input_buffer.hpp"

#include <utility>

namespace clew::runtime {

InputBuffer::InputBuffer(const NodePorts& ports, std::size_t depth)
    : inputs_(ports.inputs), delayed_(ports.delayed_inputs), slots_(depth) {}

void InputBuffer::restart_at(std::uint64_t tick) {
  for (std::uint64_t t = next_tick_; t < next_tick_ + slots_.size(); ++t) {
    const bool stays = t >= tick && t - tick < slots_.size();
    if (!stays) slots_[t % slots_.size()].present.reset();
  }
  next_tick_ = tick;
}

TopicSet InputBuffer::needed(std::uint64_t tick) const {
  return tick == 0 ? inputs_ : inputs_ | delayed_;
}

bool InputBuffer::ready() const {
  return slots_[next_tick_ % slots_.size()].present == needed(next_tick_);
}

TopicSet InputBuffer::take(domain::Messages& messages) {
  Slot& slot = slots_[next_tick_ % slots_.size()];
  for (Topic topic : domain::kAllTopics) {
    if (!slot.present[static_cast<std::size_t>(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = static_cast<std::size_t>(decltype(constant)::value);
      std::swap(std::get<kIndex>(messages), std::get<kIndex>(slot.messages));
    });
  }
  ++next_tick_;
  return std::exchange(slot.present, {});
}

}  // namespace clew::runtime
