// SPDX-License-Identifier: Apache-2.0
#include "replay/recorded_past.hpp"

#include <fmt/format.h>

#include <utility>

#include "replay/black_box_past.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::bridge {

using core::Result;
using domain::Topic;

Result<RecordedPast> RecordedPast::begin(const RunRecording& recording,
                                         const runtime::RunPlan& plan,
                                         std::vector<runtime::NodeSuccession> nodes,
                                         FedNode recorded_robot) {
  RecordedPast past;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    if (!stage.deployment.is_ours()) past.not_ours_ |= stage.ports.outputs;
  }
  for (runtime::NodeSuccession& node : nodes) {
    if (is_robot(node)) {
      // NOLINTNEXTLINE(bugprone-use-after-move): a run has one robot
      past.fed_.push_back(std::move(recorded_robot));
      past.new_robot_ = std::move(node);
    } else {
      past.fed_.emplace_back(std::move(node));
      CLEW_RETURN_IF_ERROR(begin_in_black_box(recording, plan, past.fed_.back()));
    }
  }
  return past;
}

runtime::TopicSet RecordedPast::topics() const {
  runtime::TopicSet topics = not_ours_;
  for (const FedNode& fed : fed_) topics |= fed.fed_topics() | fed.node().ports().outputs;
  return topics;
}

Result<void> RecordedPast::add(const RecordedTick& recorded) {
  if (recorded.present() != topics()) {
    return core::Error{fmt::format("lacks a sample of tick {}", recorded.tick())};
  }
  for (FedNode& fed : fed_) CLEW_RETURN_IF_ERROR(fed.step(recorded));
  for (Topic topic : domain::kAllTopics) {
    if (recorded.has(topic)) CLEW_RETURN_IF_ERROR(account(topic, recorded));
  }
  return {};
}

Result<void> RecordedPast::check_outputs(const RecordedTick& recorded) {
  for (const FedNode& fed : fed_) {
    for (Topic topic : fed.node().ports().output_order) {
      const std::string_view written = domain::visit_topic(topic, [&](auto constant) {
        return std::get<constant.kIndex>(codecs_).encode(std::get<constant.kIndex>(fed.messages()));
      });
      if (written == recorded.cdr(topic)) continue;
      return core::Error{
          fmt::format("{} of this version does not write the '{}' that is recorded "
                      "at tick {}",
                      fed.node().name(), domain::topic_name(topic), recorded.tick())};
    }
  }
  return {};
}

bool RecordedPast::has_ended() const {
  const auto& truth = account_.statistics().truth;
  return truth && truth->outcome != domain::Outcome::kRunning;
}

Result<void> RecordedPast::hand_over(ComposedStart& start) {
  for (FedNode& fed : fed_) {
    if (is_robot(fed.node())) {
      new_robot_->skip_to(start.next_tick);
      CLEW_RETURN_IF_ERROR(new_robot_->load(fed.node().save()));
      start.nodes.push_back(std::move(*new_robot_));
    } else {
      start.nodes.push_back(fed.take());
    }
  }
  start.messages = std::move(messages_);
  start.account = std::move(account_);
  return {};
}

Result<void> RecordedPast::account(Topic topic, const RecordedTick& recorded) {
  const auto decoded = domain::visit_topic(topic, [&](auto constant) {
    auto& message = std::get<constant.kIndex>(messages_);
    auto result = std::get<constant.kIndex>(codecs_).decode(recorded.cdr(topic), message);
    if (result.ok()) account_.add(message, recorded.cdr(topic));
    return result;
  });
  if (decoded.ok()) return {};
  return core::Error{fmt::format("tick {}: {}", recorded.tick(), decoded.error().message)};
}

Result<FedNode> recorded_robot(const RunRecording& recording, const runtime::RunPlan& recorded) {
  auto branch = branch_of(recording);
  if (!branch.ok()) return branch.error();
  auto node = runtime::make_node(recorded, *recorded.graph.writer_of(Topic::kState));
  if (!node.ok()) return node.error();
  const auto changes = recorded_changes(recording, recorded, *recorded.known_stages);
  if (!changes.ok()) return changes.error();
  runtime::NodeSuccession succession(std::move(node).value());
  runtime::add_successors(recorded, changes->interventions, changes->plans, succession);
  FedNode robot(std::move(succession), std::move(branch).value());
  CLEW_RETURN_IF_ERROR(begin_in_black_box(recording, recorded, robot));
  return robot;
}

}  // namespace clew::bridge
