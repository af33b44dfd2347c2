// SPDX-License-Identifier: Apache-2.0
#include "runtime/composed_executor.hpp"

#include <utility>

namespace clew::runtime {

ComposedExecutor::ComposedExecutor(std::vector<Node> nodes, SampleObserver* observer)
    : ComposedExecutor(alone(std::move(nodes)), observer, 0, {}) {}

ComposedExecutor::ComposedExecutor(std::vector<NodeSuccession> nodes, SampleObserver* observer,
                                   std::uint64_t next_tick, domain::Messages messages)
    : nodes_(std::move(nodes)),
      observer_(observer),
      messages_(std::move(messages)),
      next_tick_(next_tick) {}

void ComposedExecutor::step() {
  PartObserver* const parts = observer_ == nullptr ? nullptr : observer_->parts();
  for (NodeSuccession& node : nodes_) {
    TopicSet present = node.ports().inputs;
    // A delayed input still holds the sample of the tick before: its writer comes later.
    if (next_tick_ > 0) present |= node.ports().delayed_inputs;
    node.step(next_tick_, present, messages_, parts);
    if (observer_ == nullptr) continue;
    for (Topic topic : node.ports().output_order) observer_->on_output(topic, messages_);
  }
  ++next_tick_;
}

}  // namespace clew::runtime
