// SPDX-License-Identifier: Apache-2.0
#include "contract/mission.hpp"

#include <utility>

#include "core/hash128.hpp"
#include "stages/all.hpp"
#include "wire/codec.hpp"

namespace clew::contract {

core::Result<Mission> Mission::create(const runtime::ConfigSource& configs,
                                      const std::string& graph, const std::string& world,
                                      const std::vector<std::string>& with,
                                      const std::vector<std::string>& set) {
  runtime::GraphOverrides overrides;
  overrides.world = world;
  overrides.with = with;
  overrides.set = set;
  auto plan = runtime::prepare_run(graph, overrides, configs, stages::all());
  if (!plan.ok()) return plan.error();
  return create(std::move(plan).value());
}

core::Result<Mission> Mission::create(runtime::RunPlan plan) {
  auto nodes = runtime::make_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  return Mission(std::move(plan), std::move(nodes).value());
}

Mission::Mission(runtime::RunPlan plan, std::vector<runtime::Node> nodes)
    : plan_(std::move(plan)), nodes_(std::move(nodes)) {
  for (const runtime::Node& node : nodes_) topics_ |= node.ports().outputs;
}

void Mission::step(const Disturb& disturb, const Listen& listen) {
  constexpr auto kScan = domain::index_of(domain::Topic::kScan);
  for (runtime::Node& node : nodes_) {
    runtime::TopicSet present = node.ports().inputs;
    if (next_tick_ > 0) present |= node.ports().delayed_inputs;
    node.step(next_tick_, present, messages_);
    if (listen) listen(node.name(), node.inside(next_tick_, present, messages_));
    if (disturb && node.ports().outputs[kScan]) disturb(std::get<kScan>(messages_));
  }
  ++next_tick_;
}

bool Mission::over() const {
  return next_tick_ > 0 && state().outcome != domain::Outcome::kRunning;
}

Mission::Saved Mission::save() const {
  Saved saved;
  for (const runtime::Node& node : nodes_) saved.nodes.push_back(node.save());
  saved.messages = messages_;
  saved.next_tick = next_tick_;
  return saved;
}

core::Result<void> Mission::load(const Saved& saved) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    CLEW_RETURN_IF_ERROR(nodes_[i].load(saved.nodes[i]));
  }
  messages_ = saved.messages;
  next_tick_ = saved.next_tick;
  return {};
}

std::string Mission::digest() const {
  std::string all;
  for (const domain::Topic topic : domain::kAllTopics) all += digest_of(topic);
  return all;
}
std::string Mission::digest_of(domain::Topic topic) const {
  core::HashChain chain;
  domain::visit_topic(topic, [&](auto constant) {
    using Message = domain::MessageOf<decltype(constant)::value>;
    const Message& message = std::get<Message>(messages_);
    chain.add(message.stamp.tick, message.stamp.sequence, bridge::Codec<Message>().encode(message));
  });
  return chain.value().hex();
}

}  // namespace clew::contract
