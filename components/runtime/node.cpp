// SPDX-License-Identifier: Apache-2.0
#include "runtime/node.hpp"

#include <utility>

#include "domain/reset.hpp"

namespace clew::runtime {

NodePorts resolve_ports(const StageInfo& stage, const TopicSet& written,
                        const TopicSet& taken_over) {
  NodePorts ports;
  for (const PortInfo& port : stage.ports) {
    const std::size_t index = index_of(port.topic);
    if (port.direction == PortInfo::Direction::kOutput) {
      if (port.need == PortInfo::Need::kFallback && taken_over[index]) continue;
      ports.outputs.set(index);
      ports.output_order.push_back(port.topic);
      continue;
    }
    ports.declared_inputs.set(index);
    if (!written[index]) continue;
    if (port.need == PortInfo::Need::kFallback && written[index_of(port.instead_of)]) continue;
    (port.delayed ? ports.delayed_inputs : ports.inputs).set(index);
  }
  return ports;
}

Node::Node(std::string name, NodePorts ports, std::unique_ptr<Component> component, double tick_s)
    : name_(std::move(name)),
      ports_(std::move(ports)),
      component_(std::move(component)),
      tick_s_(tick_s) {}

void Node::step(std::uint64_t tick, const TopicSet& present, domain::Messages& messages,
                PartObserver* parts) {
  for (Topic topic : ports_.output_order) {
    domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = index_of(decltype(constant)::value);
      auto& message = std::get<kIndex>(messages);
      domain::reset(message);
      message.stamp = {tick, static_cast<double>(tick) * tick_s_, next_sequence_[kIndex]++};
    });
  }
  const TickInputs inputs(messages, ports_.declared_inputs, present, tick);
  TickOutputs outputs(messages, ports_.outputs, parts);
  component_->step(inputs, outputs);
}

domain::Inside Node::inside(std::uint64_t tick, const TopicSet& present,
                            const domain::Messages& messages) const {
  domain::Inside inside;
  const TickInputs samples(messages, ports_.declared_inputs | ports_.outputs,
                           present | ports_.outputs, tick);
  component_->tell(samples, inside);
  return inside;
}

std::string Node::save() const {
  core::StateWriter writer;
  writer(next_sequence_);
  component_->save(writer);
  return writer.take();
}

core::Result<void> Node::load(const std::string& bytes) {
  core::StateReader reader(bytes);
  reader(next_sequence_);
  component_->load(reader);
  if (!reader.complete()) {
    return core::Error{"the saved state of " + name_ +
                       " is not one of this component: " + reader.fault()};
  }
  return {};
}

}  // namespace clew::runtime
