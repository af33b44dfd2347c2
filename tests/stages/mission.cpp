// SPDX-License-Identifier: Apache-2.0
#include "mission.hpp"

#include <gtest/gtest.h>

#include "core/hash128.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"
#include "wire/codec.hpp"

namespace clew::stages {
namespace {

runtime::ConfigPath configs() { return runtime::ConfigPath({tests::source_path("configs")}); }

core::Result<runtime::RunPlan> prepare(const std::string& graph, const std::string& world,
                                       const std::vector<std::string>& with,
                                       const std::vector<std::string>& set) {
  runtime::GraphOverrides overrides;
  overrides.world = world;
  overrides.with = with;
  overrides.set = set;
  return runtime::prepare_run(graph, overrides, configs(), all());
}

runtime::RunPlan make_plan(const std::string& graph, const std::string& world,
                           const std::vector<std::string>& with,
                           const std::vector<std::string>& set) {
  auto plan = prepare(graph, world, with, set);
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

}  // namespace

std::vector<std::string> shipped_graphs() { return configs().names("graphs"); }

std::string Mission::refusal(const std::string& graph, const std::string& world,
                             const std::vector<std::string>& with) {
  const auto plan = prepare(graph, world, with, {});
  return plan.ok() ? std::string() : plan.error().text();
}

Mission::Mission(const std::string& graph, const std::string& world,
                 const std::vector<std::string>& with, const std::vector<std::string>& set)
    : plan_(make_plan(graph, world, with, set)), nodes_(runtime::make_nodes(plan_).value()) {}

void Mission::step() {
  for (runtime::Node& node : nodes_) {
    runtime::TopicSet present = node.ports().inputs;
    if (next_tick_ > 0) present |= node.ports().delayed_inputs;
    node.step(next_tick_, present, messages_);
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

void Mission::load(const Saved& saved) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto loaded = nodes_[i].load(saved.nodes[i]);
    EXPECT_TRUE(loaded.ok()) << loaded.error().text();
  }
  messages_ = saved.messages;
  next_tick_ = saved.next_tick;
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

}  // namespace clew::stages
